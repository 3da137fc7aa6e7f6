// Hex meshes and grids with everything a file can carry.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "helpers.h"

namespace hexwright::test {

/// A box of 2 x 3 x 2 hexes with a region per hex and labels on its whole boundary: patch = side,
/// four edges as curves, two of their ends as corners; one quad and one edge without a number.
inline HexMesh labelled_box() {
  HexMesh mesh = box_hex_mesh(2, 3, 2);
  for (VertId v : mesh.positions.ids()) mesh.positions[v] += Vec3{1.0 / 3, -1e-9, 1e5};
  for (HexId h : mesh.hexes.ids()) mesh.region.push_back(h.value() % 3);
  for (HexFace face : compute_hex_neighbors(mesh).boundary)
    mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(face.lf)});
  mesh.labels.quads.back().patch = PatchId();
  const auto& first = mesh.hexes[HexId(0)];
  for (std::size_t e = 0; e < 4; ++e)
    mesh.labels.edges.push_back({{first[e], first[4 + e]}, e == 3 ? CurveId() : CurveId(e)});
  mesh.labels.corners = {first[0], first[1]};
  return mesh;
}

/// The same box near the origin, every quad in a patch, with names that formats spell differently
/// or cannot hold: two patches that differ by case alone, blanks, letters beyond ASCII, two patches
/// of one group, and things without a name.
inline HexMesh named_box() {
  HexMesh mesh = labelled_box();
  for (VertId v : mesh.positions.ids()) mesh.positions[v] -= Vec3{0, 0, 1e5};
  mesh.labels.quads.back().patch = PatchId(5);
  mesh.labels.patch_names = {"inlet", "Inlet", "outer wall", "wall.1", "wall.2", ""};
  mesh.labels.curve_names = {"rim", "1st edge", ""};
  mesh.region_names = {"steel", "", "cuivre \xc3\xa9tam\xc3\xa9"};
  return mesh;
}

/// The named box with mid-nodes: no two edges have the same offset from their chord.
inline HexMesh curved_box() {
  HexMesh mesh = named_box();
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  for (Vec3& p : mesh.mid_nodes->edges) p += {offset(random), offset(random), offset(random)};
  return mesh;
}

/// A grid over the given roots, split at random `depth` times.
inline Grid random_grid(const GridFrame& frame, std::vector<LatticeCoord> roots, int depth,
                        unsigned seed) {
  std::vector<CellSpec> cells;
  for (const LatticeCoord& root : roots) cells.push_back({0, root});
  Grid grid = make_grid(frame, std::move(roots), cells);
  std::mt19937 random(seed);
  for (int k = 0; k < depth; ++k) {
    std::vector<char> is_marked(grid.num_cells());
    for (char& mark : is_marked) mark = random() % 3 == 0;
    is_marked[random() % is_marked.size()] = 1;
    grid = split_cells(grid, is_marked);
  }
  return grid;
}

/// Eight root cubes around a hole.
inline const std::vector<LatticeCoord> kRingRoots = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0},
                                                     {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}};

}  // namespace hexwright::test
