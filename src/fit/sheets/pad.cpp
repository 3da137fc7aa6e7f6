// Plans what each copy becomes on the boundary and applies the plan. A sheet that does not fit is
// left out and the others are inserted without it, so that a batch costs one rebuild of the
// adjacency however many of its sheets fail.
#include "fit/sheets/pad.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/carve/set_check.h"
#include "fit/sheets/quad_fans.h"
#include "fit/sheets/relabel.h"
#include "fit/sheets/visible.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

constexpr double kLeastCosine = 0.01;
constexpr double kCornerShare = 0.65;  // of a copy's parameter between a vertex and the next

class Padder {
 public:
  Padder(FitState& state, BoundaryState& boundary, const FeatureGraph& features,
         const SheetSets& sets)
      : state_(state),
        boundary_(boundary),
        features_(features),
        sets_(sets),
        is_in_use_(sets.num_sheets, 1),
        check_(state.mesh, state.vert_to_hex, state.neighbors, true),
        on_curve_(state.num_verts()),
        direction_(state.num_verts()) {}

  PadOutcome run() {
    place_copies();
    while (true) {
      make_plan();
      if (plan_.sheet.quads.empty()) break;
      const Insertion insertion = apply_plan(state_, boundary_, plan_);
      if (!insertion.copies.empty()) break;
      for (VertId v : insertion.stuck) block(v);
    }
    std::sort(blocked_.begin(), blocked_.end());
    blocked_.erase(std::unique(blocked_.begin(), blocked_.end()), blocked_.end());
    return {std::move(is_in_use_), std::move(blocked_)};
  }

 private:
  bool has_hexes() const { return !sets_.hex_to_sheet.empty(); }
  bool is_used(int sheet) const {
    return sheet >= 0 && is_in_use_[static_cast<std::size_t>(sheet)] != 0;
  }
  int sheet_behind(QuadId q) const { return sets_.hex_to_sheet[state_.quad_face[q.index()].hex]; }
  /// The sheet of a sheet vertex: it has no other.
  std::size_t sheet_of(VertId v) const {
    int sheet = SheetSets::kNone;
    for (QuadId q : boundary_.graph.quads(v)) sheet = std::max(sheet, sets_.quad_to_sheet[q]);
    if (has_hexes())
      for (const HexCorner& corner : state_.vert_to_hex[v])
        sheet = std::max(sheet, sets_.hex_to_sheet[corner.hex]);
    return static_cast<std::size_t>(sheet);
  }
  void block(VertId v) {
    is_in_use_[sheet_of(v)] = 0;
    blocked_.push_back(v);
  }
  bool is_covered(QuadId q) const { return is_used(sets_.quad_to_sheet[q]); }
  /// Goes with the copies where a sheet passes; the others keep their vertices.
  bool follows(QuadId q) const {
    return !is_covered(q) && (!has_hexes() || is_used(sheet_behind(q)));
  }

  /// Finds a place for every copy; a sheet with a vertex that it cannot pass is not used.
  void place_copies() {
    make_plan();
    std::vector<VertId> failed, passable;  // sheets stay in use until all vertices are seen alike
    for (VertId v : plan_.sheet.verts) {
      const auto place = place_copy(v);
      (place ? passable : failed).push_back(v);
      if (place) on_curve_[v] = *place;
    }
    for (VertId v : failed) block(v);
    make_visible(state_, plan_.sheet, passable, kLeastCosine);
    const auto visible = find_visible_directions(state_.mesh, plan_.sheet);
    for (std::size_t i = 0; i < visible.size(); ++i) {
      direction_[plan_.sheet.verts[i]] = visible[i].direction;
      if (visible[i].cosine < kLeastCosine) block(plan_.sheet.verts[i]);
    }
  }

  /// The sheets in use as one (of several components).
  void make_plan() {
    plan_ = {};
    for (QuadId q : boundary_.quad_to_region.ids()) {
      if (is_covered(q)) plan_.sheet.add_face(state_.mesh, state_.quad_face[q.index()]);
      plan_.follows.push_back(follows(q) ? 1 : 0);
    }
    if (has_hexes()) add_hex_sets();
    plan_.sheet.collect_verts();
    for (VertId v : plan_.sheet.verts) {
      plan_.directions.push_back(direction_[v]);
      plan_.on_curve.push_back(on_curve_[v]);
    }
  }

  void add_hex_sets() {
    plan_.takes_copy.assign(state_.mesh.num_hexes(), 0);
    std::vector<HexId> hexes;
    for (HexId h : state_.mesh.hexes.ids()) {
      if (!is_used(sets_.hex_to_sheet[h])) continue;
      plan_.takes_copy[h.index()] = 1;
      hexes.push_back(h);
    }
    plan_.sheet.add_inner_faces(state_.mesh, state_.neighbors, hexes, plan_.takes_copy);
  }

  /// Absent where the sheet or its rim cannot pass; no curve where the copy is on none.
  std::optional<CurvePlace> place_copy(VertId v) {
    if (state_.move[v] != MoveIn::Space) return {};
    if (has_hexes() && !check_.is_manifold(v, plan_.takes_copy)) return {};
    if (boundary_.graph.quads(v).empty()) return CurvePlace{};  // inside the mesh
    const QuadFans fans = find_quad_fans(boundary_, v, [&](QuadId q) { return !follows(q); });
    if (fans.num_inside != 1 || fans.num_outside > 1 || fans.marked_outside.size() > 1) return {};
    if (fans.marked_outside.empty()) return CurvePlace{};
    return place_on_curve(v, fans.marked_outside[0]);
  }

  /// The rim leaves a corner along a curve of the other side, or crosses a curve: the copy lies on
  /// that curve, between the vertex and the next one.
  std::optional<CurvePlace> place_on_curve(VertId v, BoundaryEdgeId e) const {
    const CurveId c = boundary_.edge_to_curve[e];
    const FeatureCurve& curve = features_.curves[c];
    const VertId next = boundary_.graph.edge(e).other(v);
    const double length = curve.length();
    const bool is_corner = state_.kind[v] == VertKind::Corner;
    if (!is_corner && (state_.kind[v] != VertKind::Curve || state_.curve[v] != c)) return {};
    // On which end a corner lies tells the other vertex where both ends are the same.
    const auto end_arc = [&](VertId corner, VertId other) {
      bool is_start = curve.verts.front() == state_.feature_point[corner];
      if (curve.verts.front() == curve.verts.back())
        is_start = state_.kind[other] == VertKind::Corner || state_.arc[other] < 0.5 * length;
      return is_start ? 0 : length;
    };
    const double here = is_corner ? end_arc(v, next) : state_.arc[v];
    double there = state_.arc[next];
    if (state_.kind[next] == VertKind::Corner) there = is_corner ? length - here : end_arc(next, v);
    if (curve.is_closed) there -= length * std::round((there - here) / length);
    return CurvePlace{c, kCornerShare * here + (1 - kCornerShare) * there};
  }

  FitState& state_;
  BoundaryState& boundary_;
  const FeatureGraph& features_;
  const SheetSets& sets_;
  std::vector<char> is_in_use_;  // per sheet: has not failed
  std::vector<VertId> blocked_;
  SetCheck check_;
  SheetPlan plan_;                         // of the sheets in use
  IdVector<VertId, CurvePlace> on_curve_;  // of all sheets' vertices: see SheetPlan
  IdVector<VertId, Vec3> direction_;
};

}  // namespace

PadOutcome pad(FitState& state, BoundaryState& boundary, const FeatureGraph& features,
               const SheetSets& sets) {
  return Padder(state, boundary, features, sets).run();
}

}  // namespace hexwright::fitting
