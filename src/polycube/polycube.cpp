// The polycube pipeline as a list of passes: check the pair, find the lattice, sample the map; then
// complete, dualise, map back and optimise on the object's surface, and all of these again over a
// grid that is finer where the surface was missed.
//
// Based on: Pitzalis et al. 2021, section 6.2.
// Differs: the lattice's planes need not be evenly spaced; folded maps are repaired first; the loop
// over finished meshes is ours.
#include "hexwright/polycube/polycube.h"

#include <algorithm>

#include "hexwright/geometry/similarity.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/surface_distance.h"

#include "polycube/choose_lattice.h"
#include "polycube/lattice/lattice.h"
#include "polycube/map/boundary_map.h"
#include "polycube/map/map_back.h"
#include "polycube/map/refine_misses.h"
#include "polycube/map/relax.h"
#include "polycube/map/repair_map.h"
#include "polycube/map/sample_map.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright {
namespace {

void check_pair(const TetMesh& object, const TetMesh& polycube) {
  if (object.num_verts() != polycube.num_verts() || object.num_tets() != polycube.num_tets())
    throw Error(ErrorCode::BadGeometry,
                "the two meshes differ: object " + std::to_string(object.num_verts()) +
                    " vertices, " + std::to_string(object.num_tets()) + " tets; polycube " +
                    std::to_string(polycube.num_verts()) + " vertices, " +
                    std::to_string(polycube.num_tets()) +
                    " tets; both must come from one tet mesh, with other positions only");
  if (object.num_tets() == 0)
    throw Error(ErrorCode::BadGeometry,
                "the meshes hold no elements; write them with volume cells");
  for (TetId t : object.tets.ids())
    if (object.tets[t] != polycube.tets[t])
      throw Error(ErrorCode::BadGeometry,
                  "tetrahedron " + std::to_string(t.value() + 1) +
                      " has other vertices in the polycube than in the object; both meshes must "
                      "list the same tets in the same order");
}

// Tets may be listed with negative volumes throughout; both meshes are then turned.
void orient(TetMesh& object, TetMesh& polycube) {
  if (2 * polycube::count_nonpositive(polycube) <= polycube.num_tets()) return;
  for (TetId t : polycube.tets.ids()) {
    std::swap(polycube.tets[t][2], polycube.tets[t][3]);
    std::swap(object.tets[t][2], object.tets[t][3]);
  }
}

void report_lattice(const polycube::Lattice& lattice, PolycubeReport& report) {
  report.num_charts = lattice.charts.size();
  report.num_unaligned_facets = lattice.num_unaligned;
  report.max_plane_deviation = lattice.max_deviation;
  report.spacing = lattice.spacing;
  report.num_roots = lattice.roots.size();
  if (lattice.num_unaligned > 0)
    report.warnings.push_back(
        std::to_string(lattice.num_unaligned) +
        " small facets of the polycube face no axis and follow their neighbours");
  if (lattice.num_merged_charts > 0)
    report.warnings.push_back(std::to_string(lattice.num_merged_charts) +
                              " faces of the polycube are squeezed to less than the lattice shows; "
                              "they are meshed as part "
                              "of their neighbours, without edges of their own");
}

// One finished mesh. A round may come out worse than the one before (finer cells also follow folds
// of the map), so the best one is kept, not the last.
// Attempts are compared by inverted hexes first, then by distance.
struct Attempt {
  HexMesh mesh;
  Grid grid;
  std::size_t num_inverted = 0, num_bridged = 0, num_inverted_mapped = 0;
  SurfaceDistance distance;
  polycube::RelaxReport relaxed;
  std::vector<Vec3> missed;  // where finer cells would help: the surface is far, hexes are inverted

  bool beats(const Attempt& other) const {
    if (num_inverted != other.num_inverted) return num_inverted < other.num_inverted;
    return distance.max_two_way() < other.distance.max_two_way();
  }
};

/// The map's own curves count, not the surface's creases: no edge reaches this angle.
FeatureOptions without_creases() {
  FeatureOptions options;
  options.crease_angle = 4;
  return options;
}

class Mesher {
 public:
  Mesher(const TetMesh& object, const polycube::Lattice& lattice, const PolycubeOptions& options,
         const Context& context)
      : object_(object),
        lattice_(lattice),
        options_(options),
        context_(context),
        in_polycube_(lattice.tets),
        in_object_(object),
        boundary_(lattice),
        features_(polycube::object_features(object, lattice)),
        target_(wrap_target(features_.surface, without_creases())) {}

  PolycubeResult run(PolycubeReport report) {
    Grid sampled =
        polycube::sample_map({object_, lattice_, in_polycube_, boundary_}, options_, context_);
    report.num_sampled_cells = sampled.num_cells();
    Attempt best = attempt(sampled);
    report.num_rounds = 1;
    for (std::vector<Vec3> missed = best.missed;
         !missed.empty() && report.num_rounds < options_.max_rounds; ++report.num_rounds) {
      if (!split_at(missed, sampled, report)) break;
      Attempt next = attempt(sampled);
      missed = next.missed;
      if (!next.beats(best)) continue;
      best = std::move(next);
      report.num_sampled_cells = sampled.num_cells();
    }
    return conclude(std::move(best), std::move(report));
  }

 private:
  Attempt attempt(const Grid& sampled) {
    Attempt a;
    a.grid = complete(sampled, options_.complete, context_).grid;
    const DualResult dual = polycube::make_dual(a.grid, options_, context_);

    auto mapped = polycube::map_back(dual.mesh, object_, lattice_, in_polycube_);
    a.num_bridged = mapped.num_bridged;
    a.num_inverted_mapped = summarize_quality(mapped.mesh).num_inverted;
    a.relaxed =
        polycube::relax(mapped, {features_, lattice_, target_.tree}, relax_options(), context_);
    a.mesh = std::move(mapped.mesh);
    a.num_inverted = summarize_quality(a.mesh).num_inverted;
    if (options_.max_surface_error > 0) {
      DistanceOptions distance;
      distance.hot_threshold = 0.9 * options_.max_surface_error;
      a.distance = measure_distance(a.mesh, target_.tree, distance);
    }
    a.missed = a.distance.hot;
    add_inverted(a.mesh, a.missed);
    return a;
  }

  static void add_inverted(const HexMesh& mesh, std::vector<Vec3>& places) {
    const auto quality = compute_scaled_jacobians(mesh);
    for (HexId h : quality.ids())
      if (!(quality[h] > 0)) places.push_back(center_of(mesh, h));
  }

  static Vec3 center_of(const HexMesh& mesh, HexId h) {
    Vec3 center;
    for (VertId v : mesh.hexes[h]) center += mesh.positions[v] * 0.125;
    return center;
  }

  // A third of the distance allowed is left to what lies between the vertices.
  polycube::RelaxOptions relax_options() const {
    const double share = options_.max_surface_error > 0 ? options_.max_surface_error : 0.003;
    return {options_.pad, 0.33 * share * target_.diagonal()};
  }

  // Splits the cells that the missed points map into; false when none can be split.
  // Marks go to the sampled grid, not to the completed one: completion would treat its own splits
  // as wanted, and the grid would grow with every round.
  bool split_at(const std::vector<Vec3>& missed, Grid& sampled, PolycubeReport& report) const {
    const auto marks = polycube::mark_cells_of_object_points(sampled, missed, in_object_, lattice_,
                                                             options_.max_level);
    const auto num_marked = static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
    if (num_marked == 0) return false;
    if (sampled.num_cells() + 7 * num_marked > options_.max_cells) {
      report.warnings.push_back("the surface is missed, but refining there needs more than " +
                                std::to_string(options_.max_cells) + " cells; raise --max-cells");
      return false;
    }
    sampled = split_cells(sampled, marks);
    return true;
  }

  // Hexes that are not positive, with the tets that explain them.
  std::vector<FoldedHex> find_folded(const HexMesh& mesh) const {
    std::vector<FoldedHex> folded;
    const auto quality = compute_scaled_jacobians(mesh);
    std::vector<char> is_near_fold(object_.num_verts(), 0);
    for (TetId t : lattice_.tets.tets.ids())
      if (!(polycube::tet_det(polycube::tet_corners(lattice_.tets, t)) > 0))
        for (VertId v : lattice_.tets.tets[t]) is_near_fold[v.index()] = 1;
    for (HexId h : quality.ids()) {
      if (quality[h] > 0) continue;
      FoldedHex f{h, center_of(mesh, h), quality[h], {}, false};
      f.tet = in_object_.locate(f.center).tet;
      for (VertId v : object_.tets[f.tet]) f.is_map_folded |= is_near_fold[v.index()] != 0;
      folded.push_back(f);
    }
    return folded;
  }

  PolycubeResult conclude(Attempt best, PolycubeReport report) const {
    report.num_cells = best.grid.num_cells();
    report.num_bridged = best.num_bridged;
    report.num_inverted_mapped = best.num_inverted_mapped;
    report.num_off_edges = best.relaxed.num_off_edges;
    report.num_off_surface = best.relaxed.num_off_surface;
    report.max_off_surface = best.relaxed.max_off_surface / target_.diagonal();
    report.farthest_off = best.relaxed.farthest_off;
    report.max_distance = best.distance.max_two_way();
    report.folded = find_folded(best.mesh);
    Verdict verdict = judge(best.mesh, target_, {}, context_);
    return {std::move(best.mesh), std::move(best.grid), features_.surface, std::move(report),
            std::move(verdict)};
  }

  const TetMesh& object_;
  const polycube::Lattice& lattice_;
  const PolycubeOptions& options_;
  const Context& context_;
  polycube::TetLocator in_polycube_, in_object_;
  polycube::BoundaryMap boundary_;
  polycube::ObjectFeatures features_;
  Target target_;
};

/// Places the object in the unit frame, with the options that speak of its lengths.
Similarity place(TetMesh& object, PolycubeOptions& options) {
  Box3 box;
  for (const Vec3& p : object.positions) box.extend(p);
  const Similarity frame = compute_unit_frame(box);
  for (Vec3& p : object.positions) p = frame.to_unit(p);
  if (options.max_edge)
    options.max_edge = [frame, in_world = options.max_edge](const Vec3& p) {
      return frame.length_to_unit(in_world(frame.to_world(p)));
    };
  return frame;
}

}  // namespace

void PolycubeReport::to_world(const Similarity& frame) {
  for (FoldedHex& hex : folded) hex.to_world(frame);
  if (num_off_surface > 0) farthest_off = frame.to_world(farthest_off);
}

void PolycubeResult::to_world(const Similarity& frame) {
  mesh = hexwright::to_world(std::move(mesh), frame);
  surface = hexwright::to_world(std::move(surface), frame);
  report.to_world(frame);
  verdict.to_world(frame);
}

PolycubeResult mesh_polycube(const TetMesh& object_in, const TetMesh& polycube_in,
                             const PolycubeOptions& given, const Context& context) {
  const auto watch = context.watch();
  check_pair(object_in, polycube_in);
  TetMesh object = object_in, polycube = polycube_in;
  orient(object, polycube);
  PolycubeOptions options = given;
  const Similarity frame = place(object, options);

  if (options.target_hexes > 0) {
    options.max_surface_error = 0;
    options.max_stretch = polycube::find_stretch(object, polycube, options, context);
  }
  polycube::Lattice lattice = polycube::choose_lattice(object, polycube, options);
  PolycubeReport report;
  report.num_tets = object.num_tets();
  report.num_nonpositive_object = polycube::count_nonpositive(object);
  report.num_nonpositive_polycube = polycube::count_nonpositive(lattice.tets);
  report_lattice(lattice, report);
  auto repair = polycube::repair_map(object, lattice, context);
  report.num_nonpositive_left = repair.num_nonpositive;
  PolycubeResult result = Mesher(object, lattice, options, context).run(std::move(report));
  // The repair may have cut tets; the user knows those of the files.
  for (FoldedHex& f : result.report.folded) f.tet = repair.to_input[f.tet];
  result.to_world(frame);
  return result;
}

}  // namespace hexwright
