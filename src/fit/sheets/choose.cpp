// Sheets go in in batches of groups without a common vertex; after each batch the surroundings of
// its rim are relaxed, so that the next one finds room.
#include "fit/sheets/choose.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "fit/curves/curve_convexity.h"
#include "fit/sheets/groups.h"
#include "fit/sheets/pad.h"
#include "fit/sheets/pad_needs.h"
#include "mesh/quad.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr int kMaxRestarts = 6;
constexpr int kMaxFutileRestarts = 2;  // restarts in a row that leave no fewer quads unpadded
constexpr double kNegligible = 0.01;   // share of unpadded quads that is not worth a restart
constexpr int kSweepsAfterBatch = 3;
constexpr int kSweepsBeforeRetry = 6;
constexpr int kRingsBeforeRetry = 2;  // around the groups that found no room
constexpr double kRelaxWeight = 3;
// Sheets around what is in need replace a layer that would take several times as many hexes: their
// walls are less regular than a layer. Under a small group a layer costs little, and the vertices
// that it adds to the curves at its corners follow them more closely.
constexpr std::size_t kLeastQuads = 100;
constexpr double kLocalShare = 1.0 / 3;

/// Kinds, places and marks of the scaffold's boundary on the carved mesh.
void transfer_features(const FitState& scaffold, const BoundaryState& scaffold_boundary,
                       FitState& state, BoundaryState& boundary) {
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
  boundary.region_to_patch = scaffold_boundary.region_to_patch;
  std::vector<QuadLabel> labels;
  for (QuadId q : scaffold_boundary.quad_to_region.ids())
    labels.push_back({sorted(scaffold.quads[q.index()]), scaffold_boundary.quad_to_region[q]});
  boundary.rebuild(state, scaffold_boundary.marked_edges(), std::move(labels));
}

class SheetChooser {
 public:
  SheetChooser(const FitState& carved, const FitState& scaffold,
               const BoundaryState& scaffold_boundary, const FitTarget& target,
               const Context& context)
      : start_{carved, {}, {}}, target_(target), context_(context) {
    transfer_features(scaffold, scaffold_boundary, start_.state, start_.boundary);
  }

  SelectivePadding run() {
    find_groups();
    while (true) {
      SelectivePadding best = pad_with_layers();
      if (serve_needs(best)) return best;
    }
  }

 private:
  /// Local sheets come last, for layers leave more room beside them than they beside layers. Groups
  /// that found no room for their layer get them too. False when needs remain in a group that was
  /// to get no layer: then it gets one after all.
  bool serve_needs(SelectivePadding& padding) {
    IdVector<GroupId, char> is_chosen = is_local_;
    for (GroupId g : failed_) is_chosen[g] = 1;
    const auto num_left = pad_needs(padding.state, padding.boundary,
                                    {*target_.features, groups_, convex_share_}, is_chosen);
    bool is_done = true;
    for (GroupId g : num_left.ids()) {
      if (num_left[g] == 0 || is_local_[g] == 0) continue;
      is_local_[g] = 0;
      is_done = false;
    }
    return is_done;
  }

  /// The best of several orders of the layers.
  SelectivePadding pad_with_layers() {
    std::vector<GroupId> todo = choose_layers();
    std::optional<SelectivePadding> best;
    const auto max_failed_quads =
        static_cast<std::size_t>(kNegligible * static_cast<double>(start_.state.quads.size()));
    int num_futile = 0;
    for (int restart = 0; restart < kMaxRestarts && num_futile < kMaxFutileRestarts; ++restart) {
      SelectivePadding attempt = start_;
      attempt.report.num_restarts = static_cast<std::size_t>(restart);
      const std::vector<GroupId> failed = pad_groups(attempt, todo);
      for (GroupId g : failed) attempt.report.num_failed_quads += groups_.num_quads[g];
      attempt.report.num_sheets = todo.size() - failed.size();
      ++num_futile;
      if (!best || attempt.report.num_failed_quads < best->report.num_failed_quads) {
        best = std::move(attempt);
        failed_ = failed;
        num_futile = 0;
      }
      if (best->report.num_failed_quads <= max_failed_quads) break;
      bring_forward(failed, todo);
    }
    return std::move(*best);
  }

  void find_groups() {
    convex_share_ = compute_convex_shares(target_.tree.surface(), *target_.features);
    if (start_.state.side == Side::Outside)
      for (double& share : convex_share_) share = 1 - share;
    groups_ = find_padding_groups(start_.state, start_.boundary, convex_share_);
    start_.report.num_groups = groups_.num_quads.size();
    const auto num_local = count_local_hexes(start_.state, start_.boundary,
                                             {*target_.features, groups_, convex_share_});
    is_local_.assign(groups_.num_quads.size(), 0);
    for (GroupId g : groups_.num_needs.ids()) {
      if (groups_.num_needs[g] == 0) continue;
      ++start_.report.num_needed;
      const double most = kLocalShare * static_cast<double>(groups_.num_quads[g]);
      if (groups_.num_quads[g] < kLeastQuads) continue;
      is_local_[g] = num_local[g] && static_cast<double>(*num_local[g]) <= most ? 1 : 0;
    }
  }

  /// Groups with a need, small ones first.
  std::vector<GroupId> choose_layers() {
    std::vector<GroupId> todo;
    for (GroupId g : groups_.num_needs.ids())
      if (groups_.num_needs[g] > 0 && is_local_[g] == 0) todo.push_back(g);
    std::stable_sort(todo.begin(), todo.end(), [&](GroupId x, GroupId y) {
      return groups_.num_quads[x] < groups_.num_quads[y];
    });
    is_urgent_.assign(groups_.num_quads.size(), 0);
    return todo;
  }

  /// Groups that found no room go first next time.
  void bring_forward(const std::vector<GroupId>& failed, std::vector<GroupId>& todo) {
    for (GroupId g : failed) is_urgent_[g] = 1;
    std::stable_partition(todo.begin(), todo.end(), [&](GroupId g) {
      return std::find(failed.begin(), failed.end(), g) != failed.end();
    });
  }

  /// Returns the groups that got no sheet.
  std::vector<GroupId> pad_groups(SelectivePadding& attempt, std::vector<GroupId> todo) const {
    std::vector<GroupId> failed;
    while (!todo.empty()) {
      context_.check_cancelled();
      const std::size_t num_old_verts = attempt.state.num_verts();
      const std::vector<GroupId> batch = take_batch(attempt, todo);
      std::vector<GroupId> unfit = pad_batch(attempt, batch);
      if (!unfit.empty()) {
        relax(attempt.state, copies_near(attempt, unfit), kSweepsBeforeRetry);
        unfit = pad_batch(attempt, unfit);
      }
      failed.insert(failed.end(), unfit.begin(), unfit.end());
      relax(attempt.state, copies_from(attempt.state, num_old_verts), kSweepsAfterBatch);
    }
    return failed;
  }

  /// Returns the groups of the batch whose sheets do not fit.
  std::vector<GroupId> pad_batch(SelectivePadding& attempt,
                                 const std::vector<GroupId>& batch) const {
    IdVector<GroupId, int> group_to_sheet(groups_.num_quads.size(), SheetSets::kNone);
    for (std::size_t i = 0; i < batch.size(); ++i) group_to_sheet[batch[i]] = static_cast<int>(i);
    SheetSets sets;
    sets.num_sheets = batch.size();
    for (RegionId r : attempt.boundary.quad_to_region)
      sets.quad_to_sheet.push_back(group_to_sheet[groups_.region_to_group[r]]);
    const auto is_done = pad(attempt.state, attempt.boundary, *target_.features, sets).is_done;
    std::vector<GroupId> unfit;
    for (std::size_t i = 0; i < batch.size(); ++i)
      if (!is_done[i]) unfit.push_back(batch[i]);
    return unfit;
  }

  /// Takes groups from the list, in order, whose quads share no vertex with those taken before,
  /// nor with urgent ones left behind: those go before their neighbours.
  std::vector<GroupId> take_batch(const SelectivePadding& attempt,
                                  std::vector<GroupId>& todo) const {
    IdVector<GroupId, std::vector<VertId>> verts(groups_.num_quads.size());
    for (QuadId q : attempt.boundary.quad_to_region.ids()) {
      auto& list = verts[groups_.region_to_group[attempt.boundary.quad_to_region[q]]];
      const auto& quad = attempt.state.quads[q.index()];
      list.insert(list.end(), quad.begin(), quad.end());
    }
    std::vector<char> is_used(attempt.state.num_verts(), 0);
    std::vector<GroupId> batch, rest;
    for (GroupId g : todo) {
      const bool is_blocked = std::any_of(verts[g].begin(), verts[g].end(),
                                          [&](VertId v) { return is_used[v.index()] != 0; });
      (is_blocked ? rest : batch).push_back(g);
      if (is_blocked && !is_urgent_[g]) continue;
      for (VertId v : verts[g]) is_used[v.index()] = 1;
    }
    todo = std::move(rest);
    return batch;
  }

  /// Boundary vertices, from `first` on, that are copies: those on rims.
  std::vector<char> copies_from(const FitState& state, std::size_t first) const {
    std::vector<char> is_copy(state.num_verts(), 0);
    for (std::size_t i = std::max(first, start_.state.num_verts()); i < is_copy.size(); ++i)
      is_copy[i] = state.is_boundary(VertId(i)) ? 1 : 0;
    return is_copy;
  }

  /// Copies on rims that are near some groups' quads: what may take the room of their sheets.
  std::vector<char> copies_near(const SelectivePadding& attempt,
                                const std::vector<GroupId>& groups) const {
    const FitState& state = attempt.state;
    IdVector<GroupId, char> is_asked(groups_.num_quads.size(), 0);
    for (GroupId g : groups) is_asked[g] = 1;
    std::vector<char> is_near(state.num_verts(), 0);
    for (QuadId q : attempt.boundary.quad_to_region.ids())
      if (is_asked[groups_.region_to_group[attempt.boundary.quad_to_region[q]]])
        for (VertId v : state.quads[q.index()]) is_near[v.index()] = 1;
    grow_vert_set(state, is_near, kRingsBeforeRetry);
    const std::vector<char> is_copy = copies_from(state, 0);
    for (std::size_t i = 0; i < is_near.size(); ++i) is_near[i] &= is_copy[i];
    return is_near;
  }

  /// Sweeps over a set of vertices and one ring around them, with a slight pull to the targets.
  void relax(FitState& state, std::vector<char> is_member, int num_sweeps) const {
    grow_vert_set(state, is_member, 1);
    update_targets(state, target_, 1, is_member);
    state.update_sizes();
    const LocalSweep local(state, is_member);
    for (int k = 0; k < num_sweeps; ++k) local.run(state, {{0.9, 1, 0}, kRelaxWeight, 0.03});
  }

  SelectivePadding start_;
  const FitTarget& target_;
  const Context& context_;
  IdVector<CurveId, double> convex_share_;  // seen from outside the mesh
  PaddingGroups groups_;
  std::vector<GroupId> failed_;        // found no room for their layer in the best start
  IdVector<GroupId, char> is_local_;   // gets sheets around what is in need only
  IdVector<GroupId, char> is_urgent_;  // failed in an earlier start
};

}  // namespace

SelectivePadding choose_sheets(const FitState& carved, const FitState& scaffold,
                               const BoundaryState& scaffold_boundary, const FitTarget& target,
                               const Context& context) {
  return SheetChooser(carved, scaffold, scaffold_boundary, target, context).run();
}

}  // namespace hexwright::fitting
