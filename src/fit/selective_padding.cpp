// Sheets go in in batches of groups without a common vertex; after each batch the surroundings of
// its rim are relaxed, so that the next one finds room.
#include "fit/selective_padding.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "fit/curve_convexity.h"
#include "fit/extrude_regions.h"
#include "fit/finish.h"
#include "fit/padding_groups.h"
#include "fit/sweep.h"
#include "fit/targets.h"

namespace hexwright::fitting {
namespace {

constexpr int kMaxRestarts = 6;
constexpr int kSweepsAfterBatch = 3;
constexpr int kSweepsBeforeRetry = 6;
constexpr double kRelaxWeight = 3;

/// Kinds, places and marks of the scaffold's boundary on the carved mesh.
void transfer_features(const FitState& scaffold, const FeatureMarks& scaffold_marks,
                       FitState& state, FeatureMarks& marks) {
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v)) continue;
    state.kind[v] = scaffold.kind[v];
    state.patch[v] = scaffold.patch[v];
    state.curve[v] = scaffold.curve[v];
    state.arc[v] = scaffold.arc[v];
    state.feature_point[v] = scaffold.feature_point[v];
    state.target[v] = scaffold.target[v];
    state.direction[v] = scaffold.direction[v];
  }
  marks.edges = scaffold_marks.edges;
  marks.region_to_patch = scaffold_marks.region_to_patch;
  std::vector<QuadLabel> labels;
  for (QuadId q : scaffold_marks.quad_to_region.ids())
    labels.push_back({sorted_verts(scaffold.quads[q.index()]), scaffold_marks.quad_to_region[q]});
  restore_regions(state, std::move(labels), marks);
}

class SelectivePadder {
 public:
  SelectivePadder(const FitState& carved, const FitState& scaffold,
                  const FeatureMarks& scaffold_marks, const FitTarget& target,
                  const Context& context)
      : start_{carved, {}, {}}, target_(target), context_(context) {
    transfer_features(scaffold, scaffold_marks, start_.state, start_.marks);
  }

  SelectivePadding run() {
    std::vector<GroupId> todo = choose_groups();
    std::optional<SelectivePadding> best;
    for (int restart = 0; restart < kMaxRestarts; ++restart) {
      context_.check_cancelled();
      SelectivePadding attempt = start_;
      attempt.report.num_restarts = static_cast<std::size_t>(restart);
      const std::vector<GroupId> failed = extrude_all(attempt, todo, restart > 0);
      for (GroupId g : failed) attempt.report.num_failed_quads += groups_.num_quads[g];
      attempt.report.num_sheets = todo.size() - failed.size();
      if (!best || attempt.report.num_failed_quads < best->report.num_failed_quads)
        best = std::move(attempt);
      if (failed.empty()) break;
      bring_forward(failed, todo);
    }
    return std::move(*best);
  }

 private:
  /// Groups with a need, small ones first.
  std::vector<GroupId> choose_groups() {
    auto convex_share = compute_convex_shares(target_.tree.surface(), *target_.features);
    if (start_.state.side == Side::Outside)
      for (double& share : convex_share) share = 1 - share;
    const MarkedGraph marked(start_.state, start_.marks);
    groups_ = find_padding_groups(start_.state, start_.marks, marked, convex_share);
    std::vector<GroupId> todo;
    for (GroupId g : groups_.num_needs.ids())
      if (groups_.num_needs[g] > 0) todo.push_back(g);
    std::stable_sort(todo.begin(), todo.end(), [&](GroupId x, GroupId y) {
      return groups_.num_quads[x] < groups_.num_quads[y];
    });
    start_.report.num_groups = groups_.num_quads.size();
    start_.report.num_needed = todo.size();
    return todo;
  }

  static void bring_forward(const std::vector<GroupId>& failed, std::vector<GroupId>& todo) {
    std::stable_partition(todo.begin(), todo.end(), [&](GroupId g) {
      return std::find(failed.begin(), failed.end(), g) != failed.end();
    });
  }

  /// Returns the groups that got no sheet.
  std::vector<GroupId> extrude_all(SelectivePadding& attempt, std::vector<GroupId> todo,
                                   bool keeps_order) {
    std::vector<GroupId> failed;
    while (!todo.empty()) {
      const std::vector<GroupId> batch = take_batch(attempt, todo, keeps_order);
      if (!extrude(attempt, batch))
        for (GroupId g : batch)
          if (!extrude_alone(attempt, g)) failed.push_back(g);
      relax(attempt.state, kSweepsAfterBatch);
    }
    return failed;
  }

  bool extrude_alone(SelectivePadding& attempt, GroupId g) {
    if (extrude(attempt, {g})) return true;
    relax(attempt.state, kSweepsBeforeRetry);
    return extrude(attempt, {g});
  }

  bool extrude(SelectivePadding& attempt, const std::vector<GroupId>& batch) {
    IdVector<RegionId, char> is_chosen(groups_.region_to_group.size(), 0);
    for (RegionId r : is_chosen.ids())
      is_chosen[r] =
          std::find(batch.begin(), batch.end(), groups_.region_to_group[r]) != batch.end();
    return extrude_regions(attempt.state, attempt.marks, *target_.features, is_chosen);
  }

  /// Takes groups from the list, in order, whose quads share no vertex with those taken before;
  /// `keeps_order` stops at the first that does.
  std::vector<GroupId> take_batch(const SelectivePadding& attempt, std::vector<GroupId>& todo,
                                  bool keeps_order) const {
    IdVector<GroupId, std::vector<VertId>> verts(groups_.num_quads.size());
    for (QuadId q : attempt.marks.quad_to_region.ids()) {
      auto& list = verts[groups_.region_to_group[attempt.marks.quad_to_region[q]]];
      const auto& quad = attempt.state.quads[q.index()];
      list.insert(list.end(), quad.begin(), quad.end());
    }
    std::vector<char> is_used(attempt.state.num_verts(), 0);
    std::vector<GroupId> batch, rest;
    for (GroupId g : todo) {
      const bool is_blocked = (keeps_order && !rest.empty()) ||
                              std::any_of(verts[g].begin(), verts[g].end(),
                                          [&](VertId v) { return is_used[v.index()] != 0; });
      if (is_blocked) {
        rest.push_back(g);
        continue;
      }
      batch.push_back(g);
      for (VertId v : verts[g]) is_used[v.index()] = 1;
    }
    todo = std::move(rest);
    return batch;
  }

  /// Sweeps over the copies on rims and one ring around them, with a slight pull to the targets.
  void relax(FitState& state, int num_sweeps) const {
    std::vector<char> is_member(state.num_verts(), 0);
    for (std::size_t i = start_.state.num_verts(); i < is_member.size(); ++i)
      is_member[i] = state.is_boundary(VertId(i)) ? 1 : 0;
    grow_vert_set(state, is_member, 1);
    update_targets(state, target_, 1, is_member);
    state.update_sizes();
    const LocalSweep local(state, is_member);
    for (int k = 0; k < num_sweeps; ++k) local.run(state, {{0.9, 1, 0}, kRelaxWeight, 0.03});
  }

  SelectivePadding start_;
  const FitTarget& target_;
  const Context& context_;
  PaddingGroups groups_;
};

}  // namespace

SelectivePadding pad_selectively(const FitState& carved, const FitState& scaffold,
                                 const FeatureMarks& scaffold_marks, const FitTarget& target,
                                 const Context& context) {
  return SelectivePadder(carved, scaffold, scaffold_marks, target, context).run();
}

}  // namespace hexwright::fitting
