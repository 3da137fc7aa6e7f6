#include "relax/joint/lift.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/joint/patch.h"
#include "relax/joint/region.h"
#include "relax/joint/volume_budget.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

// Slack and sags as shares of the diagonal at the tolerance kReference; slack and quad sag follow
// the tolerance, curves have one of their own.
struct Stage {
  double slack, quad_sag, curve_sag;
  double goal;  // at most
  double reach;
  bool is_patient;
};
constexpr double kReference = 0.005;
// A stage that keeps to the surface exactly before these gains next to nothing, at half the time.
constexpr Stage kStages[] = {{0.001, 0.0035, 0.0008, 1, 0.35, false},
                             {0.002, 0.0037, 0.0012, 1, 0.35, false},
                             {0.003, 0.0040, 0.0020, 0.41, 0.6, true}};
constexpr std::size_t kNumStages = std::size(kStages), kNumLastStages = 2;
constexpr double kCornerSlack = 0.00044;  // share of the diagonal

// Outwards there is always room: thin parts would swell. What all solutions together may change, as
// a share of the mesh's volume.
constexpr double kVolumeChange = 0.002;

constexpr int kRoundsPerStage = 2;
constexpr std::size_t kMaxSeeds = 3;
// Regions solved at most: where most of a mesh is poor, as of thin sheets, its shape is the bound.
constexpr std::size_t kFewRegions = 1000, kHexesPerRegion = 40;
constexpr std::size_t kBatch = 32;  // regions solved at the same time; fixed, so that the result is

double volume_of(const HexMesh& mesh) {
  double volume = 0;
  for (HexId h : mesh.hexes.ids()) volume += hex_volume(mesh.corners(h));
  return volume;
}

class JointLifter {
 public:
  JointLifter(FitState& state, const FitTarget& target)
      : state_(state),
        target_(target),
        budget_(kVolumeChange * volume_of(state.mesh)),
        num_regions_left_(kFewRegions + state.mesh.num_hexes() / kHexesPerRegion),
        quality_(compute_scaled_jacobians(state.mesh)),
        batch_of_(state.mesh.num_hexes(), 0),
        hex_mark_(state.mesh.num_hexes(), 0),
        vert_mark_(state.num_verts(), 0),
        is_tried_(state.mesh.num_hexes(), 0) {}

  void run(const JointStage& stage, const Context& context) {
    std::fill(is_tried_.begin(), is_tried_.end(), 0);
    for (int round = 0; round < kRoundsPerStage; ++round) {
      std::vector<HexId> queue = find_poor(stage.goal);
      if (queue.empty()) return;
      while (!queue.empty() && num_regions_left_ > 0) {
        context.check_cancelled();
        solve_batch(take_batch(queue, stage.goal), stage);
      }
    }
  }

 private:
  bool is_poor(HexId h, double goal) const { return quality_[h] < goal && !is_tried_[h.index()]; }

  // Worst first.
  std::vector<HexId> find_poor(double goal) const {
    std::vector<HexId> poor;
    for (HexId h : quality_.ids())
      if (is_poor(h, goal)) poor.push_back(h);
    std::stable_sort(poor.begin(), poor.end(),
                     [&](HexId a, HexId b) { return quality_[a] < quality_[b]; });
    return poor;
  }

  // Regions without a hex in common, from the front of the queue; what is in the way of an earlier
  // one stays.
  std::vector<JointRegion> take_batch(std::vector<HexId>& queue, double goal) {
    std::vector<JointRegion> batch;
    std::vector<HexId> rest;
    ++num_batches_;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      if (batch.size() == std::min(kBatch, num_regions_left_)) {
        rest.insert(rest.end(), queue.begin() + static_cast<std::ptrdiff_t>(i), queue.end());
        break;
      }
      if (!is_poor(queue[i], goal)) continue;
      const auto is_taken = [&](HexId h) { return batch_of_[h.index()] == num_batches_; };
      if (is_taken(queue[i])) {
        rest.push_back(queue[i]);
        continue;
      }
      const std::vector<HexId> seeds = find_seeds(queue[i], goal);
      const std::vector<VertId> movable = find_movable(seeds);
      const std::vector<HexId> hexes = hexes_around(movable);
      if (movable.empty()) continue;
      if (std::any_of(hexes.begin(), hexes.end(), is_taken)) {
        rest.push_back(queue[i]);
        continue;
      }
      for (HexId h : hexes) batch_of_[h.index()] = num_batches_;
      for (HexId h : seeds) is_tried_[h.index()] = 1;
      batch.emplace_back(state_, movable, hexes);
    }
    queue = std::move(rest);
    num_regions_left_ -= batch.size();
    return batch;
  }

  // The hex and the worst of the poor ones that share a vertex with it.
  std::vector<HexId> find_seeds(HexId hex, double goal) {
    std::vector<HexId> others;
    for (VertId v : state_.mesh.hexes[hex])
      for (const HexCorner& corner : state_.vert_to_hex[v])
        if (corner.hex != hex && is_poor(corner.hex, goal)) others.push_back(corner.hex);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    std::stable_sort(others.begin(), others.end(),
                     [&](HexId a, HexId b) { return quality_[a] < quality_[b]; });
    others.resize(std::min(others.size(), kMaxSeeds - 1));
    others.insert(others.begin(), hex);
    return others;
  }

  // The seeds' vertices and those one ring around; vertices of a fixed outer boundary stay.
  std::vector<VertId> find_movable(const std::vector<HexId>& seeds) {
    ++vert_round_;
    std::vector<VertId> movable;
    const auto add = [&](VertId v) {
      if (std::exchange(vert_mark_[v.index()], vert_round_) != vert_round_) movable.push_back(v);
    };
    for (HexId seed : seeds)
      for (VertId v : state_.mesh.hexes[seed]) add(v);
    const std::vector<VertId> of_seeds = movable;
    for (VertId v : of_seeds)
      for (const HexCorner& corner : state_.vert_to_hex[v])
        for (VertId w : state_.mesh.hexes[corner.hex]) add(w);
    std::erase_if(movable, [&](VertId v) { return state_.move[v] != MoveIn::Space; });
    return movable;
  }

  std::vector<HexId> hexes_around(const std::vector<VertId>& verts) {
    ++hex_round_;
    std::vector<HexId> hexes;
    for (VertId v : verts)
      for (const HexCorner& corner : state_.vert_to_hex[v])
        if (std::exchange(hex_mark_[corner.hex.index()], hex_round_) != hex_round_)
          hexes.push_back(corner.hex);
    return hexes;
  }

  void solve_batch(const std::vector<JointRegion>& batch, const JointStage& stage) {
    std::vector<std::optional<JointPatch>> solved(batch.size());
    parallel_for(
        batch.size(),
        [&](std::size_t i) {
          JointPatch patch(state_, target_, batch[i]);
          if (patch.solve(stage)) solved[i].emplace(std::move(patch));
        },
        1);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!solved[i] || !budget_.spend(solved[i]->volume_change())) continue;
      solved[i]->apply(state_);
      // What a neighbour's solution touched is worth another try.
      for (HexId h : batch[i].hexes()) {
        quality_[h] = scaled_jacobian(state_.mesh.corners(h));
        is_tried_[h.index()] = 0;
      }
    }
  }

  FitState& state_;
  const FitTarget& target_;
  VolumeBudget budget_;  // of all solutions
  std::size_t num_regions_left_;
  IdVector<HexId, double> quality_;
  std::vector<int> batch_of_;              // per hex: the last batch with a region that holds it
  std::vector<int> hex_mark_, vert_mark_;  // per element: the last round of a search that met it
  int num_batches_ = 0, hex_round_ = 0, vert_round_ = 0;
  std::vector<char> is_tried_;  // since something around it moved
};

JointStage scale_stage(const Stage& stage, double diagonal, const JointLiftOptions& options) {
  const double share = options.tolerance / kReference;
  return {stage.slack * share,
          stage.quad_sag * share,
          stage.curve_sag * diagonal,
          kCornerSlack * diagonal,
          std::min(stage.goal, options.goal),
          stage.reach,
          stage.is_patient};
}

}  // namespace

void lift_jointly(FitState& state, const FitTarget& target, const JointLiftOptions& options,
                  const Context& context) {
  update_targets(state, target, 0);
  JointLifter lifter(state, target);
  for (std::size_t s = options.is_last ? kNumStages - kNumLastStages : 0; s < kNumStages; ++s)
    lifter.run(scale_stage(kStages[s], target.tree.diagonal(), options), context);
}

}  // namespace hexwright::relax
