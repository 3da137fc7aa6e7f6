// Meshes with labelled patches, and measures of the layers in a mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "hexwright/layers/layers.h"
#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/quality/hex_quality.h"

#include "helpers.h"
#include "solids.h"

namespace hexwright::test {

/// A box of nx x ny x nz unit hexes whose sides are patches xmin, xmax, ymin ... with their edges
/// and corners.
inline HexMesh labelled_box(int nx, int ny, int nz) {
  HexMesh mesh = box_hex_mesh(nx, ny, nz);
  mesh.labels.patch_names = IdVector<PatchId, std::string>(
      std::vector<std::string>{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"});
  const Vec3 size{double(nx), double(ny), double(nz)};
  std::map<std::array<VertId, 2>, std::vector<int>> edge_to_sides;
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    const auto quad = face_verts(mesh, face);
    mesh.labels.quads.push_back({quad, PatchId(face.lf)});
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId a = quad[k], b = quad[(k + 1) % 4];
      edge_to_sides[{std::min(a, b), std::max(a, b)}].push_back(face.lf);
    }
  }
  for (const auto& [edge, sides] : edge_to_sides)
    if (sides.size() == 2 && sides[0] != sides[1]) {
      const int low = std::min(sides[0], sides[1]), high = std::max(sides[0], sides[1]);
      mesh.labels.edges.push_back({edge, CurveId(6 * low + high)});
    }
  for (VertId v : mesh.positions.ids()) {
    const Vec3& p = mesh.positions[v];
    bool is_corner = true;
    for (int axis = 0; axis < 3; ++axis) is_corner &= p[axis] == 0 || p[axis] == size[axis];
    if (is_corner) mesh.labels.corners.push_back(v);
  }
  return mesh;
}

/// A box of four by four by four whose patch "zmin" is half of its floor, the other half "rest".
inline HexMesh box_whose_floor_goes_on() {
  HexMesh mesh = labelled_box(4, 4, 4);
  mesh.labels.patch_names.push_back("rest");
  for (LabeledQuad& quad : mesh.labels.quads) {
    bool is_half = quad.patch == PatchId(4);
    for (VertId v : quad.verts) is_half &= mesh.positions[v].x <= 2;
    if (is_half) quad.patch = PatchId(6);
  }
  return mesh;
}

inline Target box_target(int nx, int ny, int nz) {
  return wrap_target(box_surface({0, 0, 0}, {double(nx), double(ny), double(nz)}));
}

inline LayersOptions layers_of(std::initializer_list<const char*> specs) {
  LayersOptions options;
  for (const char* spec : specs) options.specs.push_back(parse_layer_spec(spec));
  return options;
}

/// Distances from the wall, by `distance_of`, of the inner vertices of each layer, sorted.
template <class Distance>
std::map<int, std::vector<double>> layer_heights(const HexMesh& mesh,
                                                 const IdVector<HexId, std::int32_t>& layer,
                                                 Distance&& distance_of) {
  std::map<int, std::vector<double>> heights;
  for (HexId h : mesh.hexes.ids())
    if (layer[h] > 0)
      for (std::size_t k = 0; k < 4; ++k)  // the inner face of a layer's hex
        heights[layer[h]].push_back(distance_of(mesh.positions[mesh.hexes[h][k]]));
  for (auto& [number, values] : heights) std::sort(values.begin(), values.end());
  return heights;
}

inline double median(const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; }

}  // namespace hexwright::test
