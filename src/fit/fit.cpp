// The stage's driver: a list of passes. See docs/algorithms/fit.md.
//
// Guarantee: the mesh starts valid (carving keeps valid hexes, padding is thinned until valid) and
// every later change of a position is accepted only when the corner determinants around it stay
// positive.
#include "hexwright/fit/fit.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "hexwright/base/assert.h"
#include "hexwright/base/function_ref.h"
#include "hexwright/geometry/surface_names.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/carve/keep_side.h"
#include "fit/curves/judge_curves.h"
#include "fit/curves/name_labels.h"
#include "fit/pass_clock.h"
#include "fit/sheets/choose.h"
#include "fit/sheets/failed.h"
#include "fit/sheets/pad_boundary.h"
#include "fit/sheets/squeezed.h"
#include "fit/unlifted.h"
#include "relax/joint/lift.h"
#include "relax/passes/finish.h"
#include "relax/passes/pass.h"
#include "relax/state/balance.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace fitting;
using namespace relax;

// How a mesh goes from the carve's staircase to the surface: rising attachment weights and the
// sweeps at each. A scaffold that curves are mapped on need not arrive as closely as one that
// stays, and the padded mesh after it has two more passes to come; more sweeps there change the
// distances little and cost quality, because they press the staircase flat before its layers may
// share the strain. Models without curves settle here, and in the closer fit after it, what their
// least will be.
struct Approach {
  int num_weights, sweeps_per_weight;
};
constexpr Approach kFinal = {8, 2}, kScaffold = {4, 2}, kPadded = {3, 1};
constexpr Approach kClose = {4, 2}, kClosePadded = {5, 1};
constexpr int kSmoothRounds = 2;
// Distance from the target, in h, that is worth quality down to FitOptions::snap_quality. Smaller
// ones change neither the distances nor the features met, only the least scaled Jacobian.
constexpr double kCostlyMiss = 0.1;
constexpr double kCostlyFloor = 0.4;  // the joint lift does not start from less without need
// Corners are single points that users look for: they are to be met within this share of the
// surface's diagonal, a little less than what the judge allows.
constexpr double kCornerMiss = 0.00045;
constexpr double kMiss = 0.02;  // distance from the target, in h, that is reported

// The first hex with a corner determinant that is not positive.
HexId find_inverted(const HexMesh& mesh) {
  const auto quality = compute_scaled_jacobians(mesh);
  for (HexId h : quality.ids())
    if (!(quality[h] > 0)) return h;
  return {};
}

void require_valid(const HexMesh& background) {
  const HexId h = find_inverted(background);
  if (h.is_valid()) {
    throw Error(
        ErrorCode::BadArgument,
        "a corner of the hex is inverted or flat; repair the mesh first (improve untangles)",
        "hex " + std::to_string(h.value()));
  }
}

std::vector<Miss> find_misses(const FitState& state) {
  std::vector<Miss> misses;
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v) || state.stars[v].empty()) continue;
    const double residual = state.residual(v);
    if (residual > kMiss) misses.push_back({state.mesh.positions[v], residual * state.size[v]});
  }
  std::stable_sort(misses.begin(), misses.end(),
                   [](const Miss& a, const Miss& b) { return a.distance > b.distance; });
  return misses;
}

// One mapping of the features with everything that follows from it.
struct Attempt {
  FitState state;
  FeatureMapping mapping;
  BoundaryState boundary;
  PatchIndex patches;
  CurveVerdicts verdicts;
};

}  // namespace

/// What the last passes start from: everything has arrived, nothing has been given away yet.
struct FitMemory {
  Attempt attempt;
  FeatureGraph features;
  FitReport report;
  Unlifted unlifted = {};
};

namespace {

void require_consistent(const FitOptions& options) {
  if (!options.do_carve && options.carve.side != Side::Inside) {
    throw Error(ErrorCode::BadArgument,
                "only the inside of an object can be fitted without carving; set side to Inside or "
                "let the stage carve");
  }
}

/// Without carving the whole mesh stands for the object, so both must lie at the same place.
void require_same_place(const HexMesh& mesh, const SurfaceTree& surface) {
  constexpr double kMaxRatio = 4;
  Box3 box;
  for (const auto& hex : mesh.hexes)
    for (VertId v : hex) box.extend(mesh.positions[v]);
  const double ratio = box.diagonal() / surface.box().diagonal();
  const double apart = distance(box.center(), surface.box().center()) / surface.box().diagonal();
  if (ratio <= kMaxRatio && ratio >= 1 / kMaxRatio && apart <= 1) return;
  throw Error(ErrorCode::BadGeometry,
              fmt::format("the mesh is {:.3g} times as large as the surface and lies {:.3g} of its "
                          "diagonals away; give both the same units and origin",
                          ratio, apart));
}

class Fitter {
 public:
  Fitter(const Target& target, const FitOptions& options, const Context& context)
      : target_(target),
        surface_(target.tree),
        options_(options),
        context_(context),
        clock_(context, report_.seconds, report_.processor_seconds) {}

  FitResult run(const HexMesh& background) {
    clock_.run("check input", 0.0, [&] {
      require_valid(background);
      if (!options_.do_carve) require_same_place(background, surface_);
    });
    std::optional<FitState> kept;
    clock_.run("carve", 0.02, [&] { kept = keep_hexes(background); });
    const FitState& carved = *kept;
    report_.num_hexes_carved = carved.mesh.num_hexes();
    if (carved.mesh.num_hexes() == 0) return {{}, std::move(report_), {}, {}};
    Attempt scaffold{carved, {}, {}, {}, {}};  // nothing mapped yet
    clock_.run("pad", 0.2, [&] {
      if (!pad_boundary(scaffold.state))
        context_.warn("no layer fits under the mesh's boundary; it is fitted without padding");
    });
    clock_.run("find features", 0.25, [&] { find_features(scaffold.state); });
    clock_.run("approach", 0.3,
               [&] { approach(scaffold, is_selective() ? kScaffold : kFinal, false); });
    Attempt result = fit_features(carved, scaffold.state);
    arrive(result);
    std::shared_ptr<FitMemory> memory;
    if (is_lifting()) memory = std::make_shared<FitMemory>(FitMemory{result, features_, report_});
    finish(result);
    if (memory && least_quality(result) < options_.lift_goal)
      memory->unlifted = Unlifted(result.state, report_.unproven, options_.lift_goal);
    else
      memory.reset();
    FitResult done = conclude(std::move(result));
    done.memory = std::move(memory);
    return done;
  }

  FitResult lift(const FitMemory& memory) {
    Attempt result = memory.attempt;
    features_ = memory.features;
    report_ = memory.report;
    finish_lifted(result);
    go_back_if_lower(result, memory.unlifted);
    return conclude(std::move(result));
  }

 private:
  // The best place for the boundary, and quality at that place.
  void arrive(Attempt& a) {
    clock_.run("balance", 0.88, [&] { balance(a); });
    clock_.run("polish", 0.9, [&] { relax::run(kPolish, a.state, target(a), context_); });
    clock_.run("snap", 0.93, [&] { snap_gently(a); });
    clock_.run("lift", 0.95, [&] { lift_worst(a.state, target(a), {}, context_); });
    clock_.run("balance", 0.96, [&] { balance(a); });
  }

  void finish(Attempt& a) {
    clock_.run("snap", 0.97, [&] { settle(a, options_.snap_quality); });
    clock_.run("smooth", 0.975, [&] { smooth(a, least_quality(a)); });
    clock_.run("prove", 0.98, [&] { prove(a); });
  }

  // The same with a boundary that may leave the surface around poor hexes.
  void finish_lifted(Attempt& a) {
    const double goal = options_.lift_goal;
    clock_.run("snap", 0.97, [&] { settle(a, std::max(options_.snap_quality, kCostlyFloor)); });
    clock_.run("lift jointly", 0.972, [&] { lift_jointly(a, false); });
    clock_.run("snap", 0.975, [&] {
      snap_to_targets(a.state, target(a), goal);  // takes back what is not needed
      settle_where_beyond(a);
    });
    clock_.run("smooth", 0.977, [&] { smooth(a, goal); });
    clock_.run("lift jointly", 0.98, [&] { lift_jointly(a, true); });
    clock_.run("prove", 0.985, [&] { prove(a); });
  }

  void go_back_if_lower(Attempt& a, const Unlifted& unlifted) {
    if (!unlifted.is_better_than(a.state, report_.unproven.size())) return;
    unlifted.restore(a.state);
    report_.unproven = unlifted.unproven();
    update_targets(a.state, target(a), 0);
  }

  void prove(Attempt& a) {
    const double slack = options_.tolerance * surface_.diagonal();
    report_.unproven = mend_unproven(a.state, target(a), slack, context_);
  }

  FitState keep_hexes(const HexMesh& background) {
    if (!options_.do_carve) return FitState(background);
    report_.carve = carve(background, surface_, target_.expected, options_.carve, context_);
    return keep_side(background, report_.carve.is_kept, options_.carve.side);
  }

  FitTarget target(const Attempt& a) const { return {surface_, &features_, &a.patches}; }

  // From the carve's staircase to the surface; curves, if mapped, are held at first.
  void approach(Attempt& a, const Approach& how, bool hold_curves) {
    run_schedule(a.state, target(a),
                 {{0, 1, 0},
                  geometric_weights(1, 300, how.num_weights),
                  how.sweeps_per_weight,
                  0.03,
                  hold_curves},
                 context_);
  }

  // Free ends and loops that not even the finest edges could follow are pruned; the mapping leaves
  // out what is too short for the edges around it.
  void find_features(const FitState& state) {
    std::vector<double> sizes;
    for (VertId v : state.kind.ids())
      if (state.is_boundary(v)) sizes.push_back(state.size[v]);
    FeatureOptions features = target_.feature_options;
    if (!sizes.empty()) {
      const auto decile = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 10);
      std::nth_element(sizes.begin(), decile, sizes.end());
      const double least = 4 * *decile;
      features.min_length = features.min_length > 0 ? std::min(features.min_length, least) : least;
    }
    const bool is_as_wished = features.min_length == target_.feature_options.min_length;
    features_ =
        is_as_wished ? target_.features : extract_features(surface_, features, target_.creases);
  }

  // Curves that turn out to be met badly are given up and the mapping done anew without them; the
  // attempt that represents more wins.
  Attempt fit_features(const FitState& carved, const FitState& scaffold) {
    FeatureMapOptions map_options;
    Attempt first = attempt(carved, scaffold, map_options);
    if (first.verdicts.num_bad == 0) return first;
    map_options.is_banned = first.verdicts.is_bad;
    Attempt second = attempt(carved, scaffold, map_options);
    if (second.verdicts.bad_length < first.verdicts.bad_length) return second;
    return first;
  }

  Attempt attempt(const FitState& carved, const FitState& scaffold,
                  const FeatureMapOptions& map_options) {
    Attempt a{scaffold, {}, {}, {}, {}};
    clock_.run("map features", 0.4, [&] { map_curves(map_options, a); });
    if (is_selective()) {
      bool is_new = false;
      clock_.run("pad selectively", 0.42, [&] { is_new = pad(carved, a); });
      if (is_new) clock_.run("approach", 0.46, [&] { approach(a, kPadded, true); });
    }
    if (!features_.empty()) clock_.run("meet curves", 0.5, [&] { meet_curves(a); });
    clock_.run("meet surface", 0.6, [&] { meet_surface(a); });
    clock_.run("refit", 0.7, [&] {
      relax::run(is_selective() ? kRefit : kThoroughRefit, a.state, target(a), context_);
    });
    if (is_selective()) {
      clock_.run("pad squeezed", 0.8,
                 [&] { pad_failed_quads(a.state, a.boundary, target(a), {}, context_); });
    }
    update_targets(a.state, target(a), 0);
    a.verdicts = judge_curves(a.state, features_, a.mapping);
    return a;
  }

  bool is_lifting() const {
    return options_.lift_goal > 0 &&
           (options_.patch_verts != PatchVerts::OnSurface || options_.lifts_off_surface);
  }

  bool is_selective() const {
    return options_.padding == Padding::Selective && !features_.empty() &&
           options_.carve.side != Side::Both;
  }

  void map_curves(const FeatureMapOptions& map_options, Attempt& a) {
    AttachedFeatures attached = attach_features(a.state, surface_, features_, map_options);
    a.mapping = std::move(attached.mapping);
    a.boundary = std::move(attached.boundary);
    a.patches = std::move(attached.patches);
  }

  // Back to the carved mesh, with sheets where the mapped curves need them. False when that is one
  // layer under everything, as on shapes whose curves separate nothing: that is the scaffold, which
  // is fitted already; and where that layer has another boundary than the carved mesh, as beside a
  // domain's side that is nearer than a cell: marks cannot go back from it.
  bool pad(const FitState& carved, Attempt& a) {
    if (carved.quads != a.state.quads) return false;
    SelectivePadding padded = choose_sheets(carved, a.state, a.boundary, target(a), context_);
    if (padded.report.num_groups == 1 && padded.state.mesh.num_hexes() >= a.state.mesh.num_hexes())
      return false;
    a.state = std::move(padded.state);
    a.boundary = std::move(padded.boundary);
    return true;
  }

  // Onto the curves, with layers where the mesh needs them to follow the curves.
  void meet_curves(Attempt& a) {
    const std::vector<double> weights = geometric_weights(3, 300, 5);
    run_schedule(a.state, target(a), {{0, 1, 0}, weights, 1, 0.03, true}, context_);
    if (is_selective() || a.state.side == Side::Both)
      return;  // sheets come later; with both sides each would need a counterpart
    if (pad_squeezed_quads(a.state, a.boundary, {}).num_sheets == 0) return;
    a.state.update_sizes();
    run_schedule(a.state, target(a), {{0, 1, 0}, weights, 1, 0.03, false}, context_);
  }

  // Onto the surface, and from the condition number's energy to the scaled Jacobian's.
  void meet_surface(Attempt& a) {
    a.state.update_sizes();
    const Approach how = is_selective() ? kClosePadded : kClose;
    run_schedule(a.state, target(a),
                 {{0.9, 1, 0},
                  geometric_weights(300, 1e5, how.num_weights),
                  how.sweeps_per_weight,
                  0.015,
                  false},
                 context_);
  }

  void lift_jointly(Attempt& a, bool is_last) {
    const double tolerance = options_.tolerance * surface_.diagonal();
    relax::lift_jointly(a.state, target(a), {tolerance, options_.lift_goal, is_last}, context_);
  }

  double least_quality(const Attempt& a) const {
    const auto quality = compute_scaled_jacobians(a.state.mesh);
    return *std::min_element(quality.begin(), quality.end());
  }

  // The average, as far as the least allows; the best offsets follow the sliding vertices.
  void smooth(Attempt& a, double floor) {
    AverageOptions average;
    average.floor = floor;
    for (int round = 0; round < kSmoothRounds; ++round) {
      if (round > 0) balance(a);
      raise_average(a.state, target(a), average, context_);
    }
  }

  void balance(Attempt& a) {
    if (options_.patch_verts == PatchVerts::OnSurface) return;
    update_targets(a.state, target(a), 0);
    balance_offsets(a.state, target(a));
  }

  // Exactly onto the targets where quality hardly suffers ...
  void snap_gently(Attempt& a) {
    snap_to_targets(a.state, target(a), std::max(options_.snap_quality, 0.4));
  }

  // ... again after the lift, at no cost to the least, and down to `floor` where the distance is
  // worth it.
  void settle(Attempt& a, double floor) {
    FitState& state = a.state;
    snap_to_targets(state, target(a), least_quality(a));
    update_targets(state, target(a), 0);
    if (snap_misses(a, floor, [&](VertId v) { return state.residual(v) > kCostlyMiss; }))
      lift_worst(state, target(a), {}, context_);
    meet_corners(state, kCornerMiss * surface_.diagonal(), floor);
  }

  // What is still farther than the judge allows goes there down to the least quality allowed.
  void settle_where_beyond(Attempt& a) {
    FitState& state = a.state;
    update_targets(state, target(a), 0);
    const double tolerance = options_.tolerance * surface_.diagonal();
    snap_misses(a, options_.snap_quality,
                [&](VertId v) { return state.residual(v) * state.size[v] > tolerance; });
    meet_corners(state, kCornerMiss * surface_.diagonal(), options_.snap_quality);
  }

  // Whether there were any. Requires current targets.
  bool snap_misses(Attempt& a, double floor, FunctionRef<bool(VertId)> is_miss) {
    std::vector<char> misses(a.state.num_verts(), 0);
    bool any = false;
    for (VertId v : a.state.kind.ids()) {
      if (a.state.stars[v].empty() || !is_miss(v)) continue;
      misses[v.index()] = 1;
      any = true;
    }
    if (any) snap_to_targets(a.state, target(a), floor, misses);
    return any;
  }

  FitResult conclude(Attempt result) {
    FitState& state = result.state;
    HEXWRIGHT_ASSERT(!find_inverted(state.mesh).is_valid());
    update_targets(state, target(result), 0);
    report_features(state, features_, result.mapping, report_);
    report_.num_hexes_padded = state.mesh.num_hexes();
    report_.misses = find_misses(state);
    state.mesh.labels = make_labels(state, result.boundary, surface_, result.patches);
    name_labels(surface_, result.patches, features_, state.mesh);
    name_body(state);
    if (state.side ==
        Side::Outside)  // counter-clockwise seen from outside the mesh, not the object
      for (LabeledQuad& quad : state.mesh.labels.quads) std::swap(quad.verts[1], quad.verts[3]);
    remove_unused_verts(state.mesh);
    return {std::move(state.mesh),
            std::move(report_),
            {},
            std::make_shared<SurfaceParts>(
                SurfaceParts{std::move(features_), std::move(result.patches)})};
  }

  // The name that the whole surface has is that of the solid; around it, that of its faces.
  void name_body(FitState& state) const {
    const std::string name = name_of_body(surface_.surface());
    if (name.empty()) return;
    if (state.side == Side::Outside) return name_all_patches(name, state.mesh.labels);
    state.mesh.region_names = {name};
    if (state.side == Side::Both) state.mesh.region_names = {"", name};
  }

  const Target& target_;
  const SurfaceTree& surface_;  // of the target
  const FitOptions& options_;
  const Context& context_;
  FeatureGraph features_;
  FitReport report_;
  PassClock clock_;
};

}  // namespace

FitResult fit_unlifted(const HexMesh& background, const Target& target, const FitOptions& options,
                       const Context& context) {
  const auto watch = context.watch();
  require_consistent(options);
  return Fitter(target, options, context).run(background);
}

FitResult lift_fit(const FitMemory& memory, const Target& target, const FitOptions& options,
                   const Context& context) {
  const auto watch = context.watch();
  return Fitter(target, options, context).lift(memory);
}

FitResult fit(const HexMesh& background, const Target& target, const FitOptions& options,
              const Context& context) {
  FitResult result = fit_unlifted(background, target, options, context);
  return result.memory ? lift_fit(*result.memory, target, options, context) : result;
}

FitResult fit(const HexMesh& background, const TriMesh& surface,
              const TargetOptions& target_options, const FitOptions& options,
              const Context& context) {
  const Target target = make_target(surface, target_options, context);
  FitResult result = fit(to_unit(background, target.frame), target, options, context);
  result.to_world(target.frame);
  return result;
}

}  // namespace hexwright
