// Options and names from a CAD model.
#include "hexwright/pipeline/mesh_cad.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "hexwright/base/name_pattern.h"
#include "hexwright/cad/cad_shape.h"
#include "hexwright/geometry/surface_names.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "base/disjoint_sets.h"
#include "mesh/hex_center.h"

namespace hexwright {
namespace {

constexpr double kDeflectionShare = 0.1;
/// Hexes asked for the solids they lie in, per connected part of the mesh.
constexpr std::size_t kProbes = 400;

/// Quads between vertices on a curved surface are about so much farther from it in the mean than
/// balanced ones; to ask for the same mean would double the hexes of rounded parts.
constexpr double kMeanOnShape = 2;

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
    const Vec3 center = center_of(mesh, hexes[i]);
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

/// Solids by the names that hexes' regions have. A rule that names none is left to the groups.
void find_solids(const CadModel& model, SizeRule& rule) {
  TriMesh region;
  for (const CadSolidId s : model.solids.ids())
    if (matches_pattern(rule.pattern, name_of(model, SolidSet{s}))) {
      TriMesh solid = surface_of(model, s);
      region.positions = std::move(solid.positions);
      for (const auto& tri : solid.tris) region.tris.push_back(tri);
    }
  if (!region.tris.empty()) rule.surface = std::make_shared<const TriMesh>(std::move(region));
}

/// Gives hexes the region of their solid.
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

/// Whether a point lies on an edge's polyline, within the tolerance.
bool is_on(const CadModel& model, const CadEdge& edge, const Vec3& p, double tolerance) {
  const auto& x = model.surface.positions;
  for (std::size_t k = 1; k < edge.verts.size(); ++k) {
    const Vec3 a = x[edge.verts[k - 1]], along = x[edge.verts[k]] - a;
    const double length_sq = norm_sq(along);
    const double share = length_sq > 0 ? std::clamp(dot(p - a, along) / length_sq, 0.0, 1.0) : 0;
    if (norm_sq(a + share * along - p) <= tolerance * tolerance) return true;
  }
  return false;
}

/// Whether a mesh edge stands for a piece of an edge: its ends are on it, its middle as near as the
/// arc over a chord is.
bool stands_for(const CadModel& model, const CadEdge& edge, const std::array<Vec3, 2>& ends,
                double tolerance) {
  constexpr double kSag = 0.25;
  const double sag = kSag * distance(ends[0], ends[1]);
  return is_on(model, edge, ends[0], tolerance) && is_on(model, edge, ends[1], tolerance) &&
         is_on(model, edge, 0.5 * (ends[0] + ends[1]), tolerance + sag);
}

/// Curves all of whose mesh edges lie on an edge with a name have that name.
void name_curves(const CadModel& model, double tolerance, HexMesh& mesh) {
  BoundaryLabels& labels = mesh.labels;
  std::map<CurveId, std::vector<std::array<Vec3, 2>>> pieces;
  for (const LabeledEdge& e : labels.edges)
    pieces[e.curve].push_back({mesh.positions[e.verts[0]], mesh.positions[e.verts[1]]});
  for (const CadEdge& edge : model.edges) {
    if (edge.name.empty()) continue;
    for (const auto& [curve, of_curve] : pieces) {
      const bool is_all = std::ranges::all_of(of_curve, [&](const std::array<Vec3, 2>& ends) {
        return stands_for(model, edge, ends, tolerance);
      });
      if (!is_all) continue;
      if (labels.curve_names.size() <= curve.index()) labels.curve_names.resize(curve.index() + 1);
      labels.curve_names[curve] = edge.name;
    }
  }
  number_repeated(labels.curve_names.raw());
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

CadInput prepare_cad(CadModel model, std::vector<PatchRule> rules, const MeshOptions& options) {
  for (PatchRule& rule : rules) find_faces(model, rule);
  RuledSurface ruled = apply_patch_rules(faces_as_groups(model), rules);
  CadSurface surface = make_cad_surface(model, std::move(ruled.surface), options.cad);
  return {std::move(model), std::move(surface), std::move(ruled.num_matched)};
}

MeshOptions options_for_cad(const MeshOptions& wishes, const CadInput& input) {
  constexpr double kMillimetre = 1e-3;  // what all CAD files are read in
  MeshOptions options = wishes;
  options.sizes.unit = kMillimetre;
  for (SizeRule& rule : options.sizes.rules)
    if (rule.where == SizeRule::Where::Region && !rule.surface) find_solids(input.model, rule);
  use_cad_features(input.surface, options.target.features);
  options.exact = make_exact_shape(input.model, input.surface);
  // The loop must see the mesh as it will be, on the shape, not balanced about it; around poor
  // hexes vertices leave it and come back as far as the hexes allow.
  options.fit.lifts_off_surface = options.fit.patch_verts == PatchVerts::Balanced;
  options.fit.patch_verts = PatchVerts::OnSurface;
  if (options.fit.lifts_off_surface) options.mean_share *= kMeanOnShape;
  return options;
}

MeshResult mesh_cad(const CadInput& input, const MeshOptions& wishes, const Context& context) {
  MeshResult result = mesh_surface(input.surface.surface, options_for_cad(wishes, input), context);
  if (wishes.fit.carve.side == Side::Inside) name_solids(input.model, result.mesh);
  const double diagonal = bounding_box(input.model.surface).diagonal();
  name_curves(input.model, wishes.sizing.tolerance * diagonal, result.mesh);
  return result;
}

}  // namespace hexwright
