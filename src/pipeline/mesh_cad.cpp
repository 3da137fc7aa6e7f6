#include "hexwright/pipeline/mesh_cad.h"

#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "hexwright/cad/cad_shape.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "base/disjoint_sets.h"

namespace hexwright {
namespace {

constexpr double kDeflectionShare = 0.1;
/// Hexes asked for the solids they lie in, per connected part of the mesh.
constexpr std::size_t kProbes = 400;

using SolidSet = std::set<CadSolidId>;

TriMesh surface_of(const CadModel& model, CadSolidId solid) {
  TriMesh mesh;
  mesh.positions = model.surface.positions;
  for (const TriId t : model.surface.tris.ids())
    if (model.faces[model.tri_to_face[t]].solid == solid)
      mesh.tris.push_back(model.surface.tris[t]);
  return mesh;
}

/// The connected parts of a mesh, each as its hexes in order.
std::vector<std::vector<HexId>> connected_parts(const HexMesh& mesh) {
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  DisjointSets sets(mesh.num_hexes());
  for (const HexId h : mesh.hexes.ids())
    for (const HexId other : neighbors.neighbor[h])
      if (other.is_valid()) sets.unite(h.index(), other.index());
  std::map<std::size_t, std::vector<HexId>> parts;
  for (const HexId h : mesh.hexes.ids()) parts[sets.find(h.index())].push_back(h);
  std::vector<std::vector<HexId>> result;
  for (auto& [root, hexes] : parts) result.push_back(std::move(hexes));
  return result;
}

SolidSet solids_in(const std::vector<HexId>& hexes, const HexMesh& mesh,
                   const std::vector<SurfaceTree>& solids) {
  SolidSet found;
  const std::size_t step = std::max<std::size_t>(1, hexes.size() / kProbes);
  for (std::size_t i = 0; i < hexes.size(); i += step) {
    Vec3 center;
    for (const Vec3& p : mesh.corners(hexes[i])) center += p / 8;
    for (std::size_t s = 0; s < solids.size(); ++s)
      if (!found.contains(CadSolidId(s)) && solids[s].is_inside(center))
        found.insert(CadSolidId(s));
  }
  return found;
}

std::string name_of(const CadModel& model, const SolidSet& solids) {
  std::string name;
  for (const CadSolidId s : solids) {
    const std::string& given = model.solids[s].name;
    name += (name.empty() ? "" : "+") +
            (given.empty() ? fmt::format("solid_{}", s.value() + 1) : given);
  }
  return name;
}

}  // namespace

CadReadOptions read_options_for(const MeshOptions& options) {
  CadReadOptions read;
  read.deflection = kDeflectionShare * options.sizing.tolerance;
  // An angle that was asked for counts; the default is for triangles, whose angles tell less.
  const double asked = options.target.features.crease_angle;
  if (asked != FeatureOptions{}.crease_angle) read.sharp_angle = asked;
  return read;
}

MeshOptions options_for_cad(const MeshOptions& wishes, const CadModel& model,
                            const CadSurface& surface) {
  MeshOptions options = wishes;
  use_cad_features(surface, options.target.features);
  options.exact = make_exact_shape(model, surface);
  // The loop must see the mesh as it will be, on the shape, not balanced about it; around poor
  // hexes vertices leave it and come back as far as the hexes allow.
  options.fit.lifts_off_surface = options.fit.patch_verts == PatchVerts::Balanced;
  options.fit.patch_verts = PatchVerts::OnSurface;
  return options;
}

void name_solids(const CadModel& model, HexMesh& mesh) {
  if (model.solids.size() == 1) {
    const std::string& name = model.solids[CadSolidId(0)].name;
    mesh.region_names.clear();
    if (!name.empty()) mesh.region_names = {name};
    return;
  }
  std::vector<SurfaceTree> solids;
  for (const CadSolidId s : model.solids.ids()) solids.emplace_back(surface_of(model, s));
  std::map<SolidSet, std::int32_t> regions;
  mesh.region.assign(mesh.num_hexes(), 0);
  mesh.region_names.clear();
  for (const std::vector<HexId>& part : connected_parts(mesh)) {
    const SolidSet set = solids_in(part, mesh, solids);
    const auto [found, is_new] =
        regions.try_emplace(set, static_cast<std::int32_t>(regions.size()));
    if (is_new) mesh.region_names.push_back(name_of(model, set));
    for (const HexId h : part) mesh.region[h] = found->second;
  }
}

}  // namespace hexwright
