// Passes: fill, keep, repair, drop crumbs, count. See docs/algorithms/fit.md, "Carve".
#include "hexwright/fit/carve.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <span>

#include "hexwright/mesh/hex_adjacency.h"

#include "base/disjoint_sets.h"
#include "fit/carve/approach_set.h"
#include "fit/carve/carve_classify.h"
#include "fit/carve/carve_repair.h"
#include "fit/carve/set_topology.h"

namespace hexwright {
namespace {

using fitting::HexFilling;
using fitting::SetScene;
using fitting::SetTopology;

// Drops face-connected components of the set with less than `share` of the largest one's volume;
// returns how many remain.
std::size_t drop_small_components(const HexMesh& mesh, const HexNeighbors& neighbors,
                                  const HexFilling& filling, double share,
                                  std::vector<char>& is_kept) {
  std::vector<int> component(mesh.num_hexes(), -1);
  std::vector<double> volume;
  std::vector<HexId> stack;
  for (HexId seed : mesh.hexes.ids()) {
    if (!is_kept[seed.index()] || component[seed.index()] >= 0) continue;
    const int c = static_cast<int>(volume.size());
    volume.push_back(0);
    component[seed.index()] = c;
    stack.push_back(seed);
    while (!stack.empty()) {
      const HexId h = stack.back();
      stack.pop_back();
      const double e = filling.edge[h];
      volume.back() += e * e * e;
      for (HexId other : neighbors.neighbor[h]) {
        if (!other.is_valid() || !is_kept[other.index()] || component[other.index()] >= 0) continue;
        component[other.index()] = c;
        stack.push_back(other);
      }
    }
  }
  if (volume.empty()) return 0;
  const double least = share * *std::max_element(volume.begin(), volume.end());
  for (std::size_t h = 0; h < is_kept.size(); ++h)
    if (is_kept[h] && volume[static_cast<std::size_t>(component[h])] < least) is_kept[h] = 0;
  return static_cast<std::size_t>(
      std::count_if(volume.begin(), volume.end(), [&](double x) { return x >= least; }));
}

// Hexes with the surface near their centres but no boundary of the kept set at any vertex: the part
// or gap there is thinner than the grid. Beyond the background nothing is kept.
std::vector<HexId> find_lost_hexes(const SetScene& scene, const std::vector<char>& is_kept) {
  constexpr char kDropped = 1, kKept = 2;
  const HexMesh& mesh = scene.mesh;
  IdVector<VertId, char> sides(mesh.num_verts(), 0);
  const auto add = [&](VertId v, char side) { sides[v] = static_cast<char>(sides[v] | side); };
  for (HexId h : mesh.hexes.ids())
    for (VertId v : mesh.hexes[h]) add(v, is_kept[h.index()] ? kKept : kDropped);
  for (const HexFace& face : scene.neighbors.boundary)
    for (VertId v : face_verts(mesh, face)) add(v, kDropped);
  std::vector<HexId> lost;
  for (HexId h : mesh.hexes.ids()) {
    if (!scene.filling.is_near[h]) continue;
    const auto& verts = mesh.hexes[h];
    const bool at_boundary = std::any_of(verts.begin(), verts.end(),
                                         [&](VertId v) { return sides[v] == (kKept | kDropped); });
    if (!at_boundary) lost.push_back(h);
  }
  return lost;
}

// Where the set's topology can be at fault: see CarveResult::thin.
std::vector<Vec3> find_thin_places(const SetScene& scene, const std::vector<char>& is_kept) {
  constexpr unsigned kAllFaces = 63;
  std::vector<Vec3> thin;
  for (HexId h : scene.mesh.hexes.ids()) {
    if (!scene.filling.is_near[h]) continue;
    const unsigned on_set = fitting::faces_on_set(scene.neighbors, is_kept, h);
    const unsigned on_own_kind = is_kept[h.index()] ? on_set : kAllFaces & ~on_set;
    if (fitting::is_one_thick(on_own_kind) || on_own_kind == kAllFaces)
      thin.push_back(scene.filling.nearest[h]);
  }
  return thin;
}

void require_positive(double keep_fraction) {
  if (!(keep_fraction > 0 && keep_fraction < 1))
    throw Error(ErrorCode::BadArgument,
                "keep_fraction must lie between 0 and 1; the default is 0.5");
}

// The hexes filled to more than a threshold, made manifold and rid of crumbs.
struct KeptSet {
  std::vector<char> in_set;
  fitting::RepairResult repair;
  std::size_t num_components = 0;
  SetTopology topology;  // of its boundary
  double threshold = 0.5;
};

// Makes the set manifold, drops crumbs and counts.
KeptSet complete_set(const SetScene& scene, std::vector<char> in_set, const CarveOptions& options) {
  KeptSet kept;
  kept.in_set = std::move(in_set);
  kept.repair = fitting::repair_set(scene.mesh, scene.vert_to_hex, scene.neighbors, scene.filling,
                                    scene.visible, kept.in_set);
  kept.num_components = drop_small_components(scene.mesh, scene.neighbors, scene.filling,
                                              options.min_component_share, kept.in_set);
  kept.topology = fitting::compute_set_topology(scene.mesh, scene.neighbors, kept.in_set);
  return kept;
}

KeptSet keep_above(const SetScene& scene, double threshold, const CarveOptions& options) {
  std::vector<char> in_set(scene.mesh.num_hexes());
  for (HexId h : scene.mesh.hexes.ids()) in_set[h.index()] = scene.filling.fraction[h] > threshold;
  KeptSet kept = complete_set(scene, std::move(in_set), options);
  kept.threshold = threshold;
  return kept;
}

// Components and handles, of the solid or through it, that the set has too many or too few.
long count_defects(const SetTopology& topology, const ExpectedTopology& expected) {
  return std::abs(static_cast<long>(topology.num_components) -
                  static_cast<long>(expected.num_components)) +
         std::abs(topology.euler_characteristic - expected.euler_characteristic) / 2;
}

// Lost hexes that share vertices, the largest such piece first.
std::vector<std::vector<HexId>> group_lost(const HexMesh& mesh, const std::vector<HexId>& lost) {
  BasicDisjointSets<std::int32_t> sets(mesh.num_verts());
  for (HexId h : lost)
    for (VertId v : mesh.hexes[h]) sets.unite(mesh.hexes[h][0].value(), v.value());
  std::map<std::int32_t, std::vector<HexId>> pieces;
  for (HexId h : lost) pieces[sets.find(mesh.hexes[h][0].value())].push_back(h);
  std::vector<std::vector<HexId>> result;
  for (auto& [root, piece] : pieces) result.push_back(std::move(piece));
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return result;
}

// The set with what touches the lost hexes kept (or dropped, where all is kept) from a quarter on.
KeptSet keep_around(const SetScene& scene, std::span<const HexId> lost, const CarveOptions& options,
                    const KeptSet& kept) {
  constexpr float kLeast = 0.25f;
  std::vector<char> in_set = kept.in_set;
  for (HexId h : lost) {
    const bool is_empty = !kept.in_set[h.index()];
    for (VertId v : scene.mesh.hexes[h])
      for (const HexCorner& corner : scene.vert_to_hex[v]) {
        const float f = scene.filling.fraction[corner.hex];
        if (is_empty ? f > kLeast : f < 1 - kLeast) in_set[corner.hex.index()] = is_empty ? 1 : 0;
      }
  }
  KeptSet other = complete_set(scene, std::move(in_set), options);
  other.threshold = kept.threshold;
  other.repair.num_flips += kept.repair.num_flips;
  return other;
}

// Fins and slits about as thick as a hex may be filled to just under one half, or emptied to just
// over, along all of their length: the set has the right topology without them. Around lost places
// less suffices. Kept as it was where that loses no less or does harm to the topology: first all
// places together, then, if that did harm, the largest ones each by itself.
void recover_lost(const SetScene& scene, const ExpectedTopology& expected,
                  const CarveOptions& options, KeptSet& kept) {
  constexpr std::size_t kMaxPieces = 12;
  if (!expected.is_known) return;
  std::size_t num_lost = find_lost_hexes(scene, kept.in_set).size();
  const auto try_pieces = [&](std::span<const HexId> lost) {
    KeptSet other = keep_around(scene, lost, options, kept);
    if (count_defects(other.topology, expected) > count_defects(kept.topology, expected))
      return false;
    const std::size_t num_left = find_lost_hexes(scene, other.in_set).size();
    if (num_left >= num_lost) return false;
    num_lost = num_left;
    kept = std::move(other);
    return true;
  };
  const auto lost = find_lost_hexes(scene, kept.in_set);
  if (lost.empty() || try_pieces(lost)) return;
  const auto pieces = group_lost(scene.mesh, lost);
  for (std::size_t i = 0; i < std::min(kMaxPieces, pieces.size()); ++i) try_pieces(pieces[i]);
}

// Walls about as thick as a hex are pierced wherever no hex is filled enough, and narrow gaps are
// bridged. Lower thresholds keep such walls whole, higher ones keep gaps open. The first threshold
// with the expected topology, or else the best, gives the topology; the set is then brought back to
// the filling without changing it.
void mend_topology(const SetScene& scene, const ExpectedTopology& expected,
                   const CarveOptions& options, KeptSet& kept) {
  constexpr double kThresholds[] = {0.4, 0.3, 0.2, 0.15, 0.1, 0.6, 0.7, 0.8};
  long least = count_defects(kept.topology, expected);
  for (double threshold : kThresholds) {
    if (least == 0) break;
    KeptSet other = keep_above(scene, threshold, options);
    const long num_defects = count_defects(other.topology, expected);
    if (num_defects >= least) continue;
    least = num_defects;
    kept = std::move(other);
  }
  if (kept.threshold != options.keep_fraction)
    kept.repair.num_flips += fitting::approach_threshold(scene, options.keep_fraction, kept.in_set);
}

}  // namespace

void CarveResult::to_world(const Similarity& frame) {
  for (Vec3& p : lost) p = frame.to_world(p);
  for (Vec3& p : thin) p = frame.to_world(p);
}

CarveResult carve(const HexMesh& background, const SurfaceTree& surface,
                  const CarveOptions& options, const Context& context) {
  return carve(background, surface, find_expected_topology(surface), options, context);
}

CarveResult carve(const HexMesh& background, const SurfaceTree& surface,
                  const ExpectedTopology& expected, const CarveOptions& options,
                  const Context& context) {
  const auto watch = context.watch();
  require_positive(options.keep_fraction);
  context.progress("carve", 0);
  const VertToHex vert_to_hex(background);
  const HexNeighbors neighbors = compute_hex_neighbors(background);
  const HexFilling filling = fitting::classify_hexes(background, vert_to_hex, neighbors, surface);
  context.check_cancelled();
  context.progress("carve", 0.5);

  const SetScene scene{background, vert_to_hex, neighbors, filling, options.visible_normal};
  KeptSet kept = keep_above(scene, options.keep_fraction, options);
  recover_lost(scene, expected, options, kept);
  if (expected.is_known) mend_topology(scene, expected, options, kept);

  CarveResult result;
  for (HexId h : find_lost_hexes(scene, kept.in_set)) result.lost.push_back(filling.nearest[h]);
  if (expected.is_known && count_defects(kept.topology, expected) > 0)
    result.thin = find_thin_places(scene, kept.in_set);
  result.is_kept = std::move(kept.in_set);
  result.num_flips = kept.repair.num_flips;
  result.num_bad_verts = kept.repair.num_bad_verts;
  result.num_components = kept.num_components;
  result.num_boundary_components = kept.topology.num_components;
  result.euler_characteristic = kept.topology.euler_characteristic;
  result.seed_fraction = kept.threshold;
  context.progress("carve", 1);
  return result;
}

HexMesh extract_hexes(const HexMesh& mesh, const std::vector<char>& is_kept) {
  HexMesh part;
  IdVector<VertId, VertId> old_to_new(mesh.num_verts());
  for (HexId h : mesh.hexes.ids()) {
    if (!is_kept[h.index()]) continue;
    auto hex = mesh.hexes[h];
    for (VertId& v : hex) {
      if (!old_to_new[v].is_valid()) old_to_new[v] = part.positions.push_back(mesh.positions[v]);
      v = old_to_new[v];
    }
    part.hexes.push_back(hex);
    if (!mesh.region.empty()) part.region.push_back(mesh.region[h]);
  }
  return part;
}

}  // namespace hexwright
