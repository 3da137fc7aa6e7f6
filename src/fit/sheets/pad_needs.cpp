// A smooth edge with one hex around it, in a region that is otherwise in line with the grid, is
// mended by a sheet around that hex: the sheet covers the boundary quads of the group and the inner
// faces. Around a row of hexes that takes about four new hexes each, of a layer one per quad.
#include "fit/sheets/pad_needs.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "fit/sheets/pad.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr int kMaxRounds = 8;

/// Hexes at vertex a, or around the edge (a, b).
template <class Visit>
void for_each_hex_in_need(const FitState& state, VertId a, VertId b, Visit&& visit) {
  for (const HexCorner& corner : state.vert_to_hex[a]) {
    const auto& hex = state.mesh.hexes[corner.hex];
    if (!b.is_valid() || std::find(hex.begin(), hex.end(), b) != hex.end()) visit(corner.hex);
  }
}

/// What the rounds of insertion have learned; vertex ids survive them.
struct Experience {
  std::vector<char> takes_all;  ///< vertices at which a set takes in every hex once it has one
  std::set<std::tuple<GroupId, VertId, VertId>> served;  ///< needs that got a sheet already
};

/// The sets of hexes that one mesh calls for.
class SetMaker {
 public:
  SetMaker(const FitState& state, const BoundaryState& boundary, const PaddingInput& input,
           const Experience& experience)
      : state_(state),
        boundary_(boundary),
        groups_(input.groups),
        experience_(experience),
        needs_(find_padding_needs(state, boundary, input.convex_share, input.groups)) {
    for (QuadId q : boundary.quad_to_region.ids())
      hex_quads_.push_back({state.quad_face[q.index()].hex, q});
    std::sort(hex_quads_.begin(), hex_quads_.end());
    collected_by_.assign(state.mesh.num_hexes(), GroupId{});
  }

  /// Ascending by group.
  const std::vector<PaddingNeed>& needs() const { return needs_; }

  /// Per need: the sheet around its hexes, or none.
  std::vector<int> served_by(const SheetSets& choice) const {
    std::vector<int> sheets;
    for (const PaddingNeed& need : needs_) {
      int sheet = SheetSets::kNone;
      for_each_hex_in_need(state_, need.a, need.b,
                           [&](HexId h) { sheet = std::max(sheet, choice.hex_to_sheet[h]); });
      sheets.push_back(sheet);
    }
    return sheets;
  }

  /// Faces of a sheet around all that the group needs.
  std::size_t count_faces(GroupId g) {
    std::size_t count = 0;
    for (HexId h : collect(g)) {
      for (HexId other : state_.neighbors.neighbor[h])
        count += other.is_valid() && collected_by_[other] != g ? 1 : 0;
      for_each_quad(h, g, [&](QuadId) { ++count; });
    }
    return count;
  }

  /// Sets of the groups chosen that share no vertex. Of sets that touch those of the first group
  /// stay, the others are left for another time.
  SheetSets choose(const IdVector<GroupId, char>& is_chosen) {
    SheetSets choice;
    choice.hex_to_sheet.assign(state_.mesh.num_hexes(), SheetSets::kNone);
    choice.quad_to_sheet.assign(state_.quads.size(), SheetSets::kNone);
    std::vector<char> is_used(state_.num_verts(), 0);
    for (std::size_t i = 0; i < needs_.size(); ++i) {
      const GroupId g = needs_[i].group;
      if (is_chosen[g] == 0 || (i > 0 && needs_[i - 1].group == g)) continue;
      for (HexId seed : collect(g))
        if (collected_by_[seed] == g) add_component(g, seed, is_used, choice);
    }
    return choice;
  }

 private:
  template <class Visit>
  void for_each_quad(HexId h, GroupId g, Visit&& visit) const {
    auto it = std::lower_bound(hex_quads_.begin(), hex_quads_.end(), std::pair(h, QuadId(0)));
    for (; it != hex_quads_.end() && it->first == h; ++it)
      if (groups_.region_to_group[boundary_.quad_to_region[it->second]] == g) visit(it->second);
  }

  /// The hexes in need of a group, and those that have to go with them, ascending.
  std::vector<HexId> collect(GroupId g) {
    std::vector<HexId> hexes;
    const auto take = [&](HexId h) {
      if (collected_by_[h] == g) return;
      collected_by_[h] = g;
      hexes.push_back(h);
    };
    const auto by_group = [](const PaddingNeed& x, const PaddingNeed& y) {
      return x.group < y.group;
    };
    const auto [first, last] =
        std::equal_range(needs_.begin(), needs_.end(), PaddingNeed{g, {}, {}}, by_group);
    for (auto need = first; need != last; ++need)
      if (experience_.served.count({g, need->a, need->b}) == 0)
        for_each_hex_in_need(state_, need->a, need->b, take);
    for (std::size_t i = 0; i < hexes.size(); ++i) {  // grows
      const auto hex = state_.mesh.hexes[hexes[i]];
      for (VertId v : hex)
        if (experience_.takes_all[v.index()] != 0) for_each_hex_in_need(state_, v, {}, take);
      for (const auto& edge : kHexEdges)
        take_around_concave_edge(hex[static_cast<std::size_t>(edge[0])],
                                 hex[static_cast<std::size_t>(edge[1])], take);
    }
    std::sort(hexes.begin(), hexes.end());
    return hexes;
  }

  /// Three hexes around a smooth edge would be four or five flat ones after one or two of them
  /// got a sheet without the others, and two after all are.
  template <class Take>
  void take_around_concave_edge(VertId a, VertId b, Take&& take) const {
    constexpr std::size_t kConcave = 3;
    if (!state_.is_boundary(a) || !state_.is_boundary(b)) return;
    const BoundaryEdgeId e = boundary_.graph.find_edge(a, b);
    if (!e.is_valid() || boundary_.is_marked(e)) return;
    std::size_t count = 0;
    for_each_hex_in_need(state_, a, b, [&](HexId) { ++count; });
    if (count >= kConcave) for_each_hex_in_need(state_, a, b, take);
  }

  /// The collected hexes that are connected with the seed by vertices; they stop being collected.
  void add_component(GroupId g, HexId seed, std::vector<char>& is_used, SheetSets& choice) {
    std::vector<HexId> hexes{seed};
    collected_by_[seed] = {};
    bool is_free = true;
    for (std::size_t i = 0; i < hexes.size(); ++i)  // grows
      for (VertId v : state_.mesh.hexes[hexes[i]]) {
        if (is_used[v.index()] != 0) is_free = false;
        for (const HexCorner& corner : state_.vert_to_hex[v]) {
          if (collected_by_[corner.hex] != g) continue;
          collected_by_[corner.hex] = {};
          hexes.push_back(corner.hex);
        }
      }
    if (!is_free) return;
    const auto sheet = static_cast<int>(choice.num_sheets++);
    for (HexId h : hexes) {
      choice.hex_to_sheet[h] = sheet;
      for (VertId v : state_.mesh.hexes[h]) is_used[v.index()] = 1;
      for_each_quad(h, g, [&](QuadId q) { choice.quad_to_sheet[q] = sheet; });
    }
  }

  const FitState& state_;
  const BoundaryState& boundary_;
  const PaddingGroups& groups_;
  const Experience& experience_;
  const std::vector<PaddingNeed> needs_;
  std::vector<std::pair<HexId, QuadId>> hex_quads_;  // ascending
  IdVector<HexId, GroupId> collected_by_;            // the group that was collected last
};

IdVector<GroupId, int> count_needs(const std::vector<PaddingNeed>& needs,
                                   const IdVector<GroupId, char>& is_chosen) {
  IdVector<GroupId, int> count(is_chosen.size(), 0);
  for (const PaddingNeed& need : needs) count[need.group] += is_chosen[need.group];
  return count;
}

}  // namespace

IdVector<GroupId, std::optional<std::size_t>> count_local_hexes(const FitState& state,
                                                                const BoundaryState& boundary,
                                                                const PaddingInput& input) {
  const Experience none{std::vector<char>(state.num_verts(), 0), {}};
  SetMaker sets(state, boundary, input, none);
  IdVector<GroupId, std::optional<std::size_t>> count(input.groups.num_quads.size(), 0);
  for (GroupId g : count.ids())
    if (input.groups.num_needs[g] > 0) count[g] = sets.count_faces(g);
  for (const PaddingNeed& need : sets.needs())
    if (need.is_concave) count[need.group] = std::nullopt;
  return count;
}

IdVector<GroupId, int> pad_needs(FitState& state, BoundaryState& boundary,
                                 const PaddingInput& input,
                                 const IdVector<GroupId, char>& is_chosen) {
  bool is_progress = std::find(is_chosen.begin(), is_chosen.end(), 1) != is_chosen.end();
  if (!is_progress) return IdVector<GroupId, int>(is_chosen.size(), 0);
  Experience experience;
  for (int round = 0;; ++round) {
    experience.takes_all.resize(state.num_verts(), 0);
    SetMaker sets(state, boundary, input, experience);
    auto num_left = count_needs(sets.needs(), is_chosen);
    const bool is_done =
        std::all_of(num_left.begin(), num_left.end(), [](int n) { return n == 0; });
    if (is_done || !is_progress || round == kMaxRounds) return num_left;
    const SheetSets choice = sets.choose(is_chosen);
    const auto served = sets.served_by(choice);
    const PadOutcome outcome = pad(state, boundary, input.features, choice);
    is_progress = false;
    for (std::size_t i = 0; i < served.size(); ++i) {
      if (served[i] < 0 || outcome.is_done[static_cast<std::size_t>(served[i])] == 0) continue;
      const PaddingNeed& need = sets.needs()[i];
      is_progress |= experience.served.insert({need.group, need.a, need.b}).second;
    }
    for (VertId v : outcome.blocked) {
      is_progress = is_progress || experience.takes_all[v.index()] == 0;
      experience.takes_all[v.index()] = 1;
    }
  }
}

}  // namespace hexwright::fitting
