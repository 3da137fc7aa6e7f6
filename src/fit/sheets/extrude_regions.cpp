// Plans the copies (what each becomes on the boundary), inserts the sheets, rewrites the marks. A
// sheet that does not fit is left out and the others are inserted without it, so that a batch costs
// one rebuild of the adjacency however many of its sheets fail.
#include "fit/sheets/extrude_regions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/carve/set_check.h"
#include "fit/carve/visible_normal.h"
#include "fit/sheets/make_visible.h"
#include "fit/sheets/quad_fans.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr double kDepth = 0.3;
constexpr double kLeastCosine = 0.01;
constexpr double kMinJacobian = 1e-6;
constexpr double kCornerShare = 0.65;  // of a copy's parameter between a vertex and the next

/// What the copy of a sheet vertex becomes.
struct CopyPlan {
  VertKind kind = VertKind::Interior;
  PatchId patch;
  CurveId curve;
  double arc = 0;
  Vec3 direction;  ///< away from the copy, unit; sees the chosen quads
};

/// Sheets of whole regions have no hexes: whatever lies behind their quads gets the copies.
WrapChoice quads_of_regions(const FeatureMarks& marks, const SheetChoice& choice) {
  WrapChoice result;
  result.num_sheets = choice.num_sheets;
  for (RegionId r : marks.quad_to_region) result.quad_to_sheet.push_back(choice.region_to_sheet[r]);
  return result;
}

class Extrusion {
 public:
  Extrusion(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
            const WrapChoice& choice)
      : state_(state),
        marks_(marks),
        features_(features),
        choice_(choice),
        is_in_use_(choice.num_sheets, 1),
        marked_(state, marks),
        check_(state.mesh, state.vert_to_hex, state.neighbors, true) {}

  WrapOutcome run() {
    plan_all();
    std::vector<VertId> copies;
    while (copies.empty()) {
      collect_sheet();
      if (sheet_.quads.empty()) break;
      SheetInsertion insertion =
          insert_sheet(state_.mesh, state_.vert_to_hex, sheet_, is_in_set_, kMinJacobian);
      copies = std::move(insertion.copies);
      for (VertId v : insertion.stuck) block(v);
    }
    std::sort(blocked_.begin(), blocked_.end());
    blocked_.erase(std::unique(blocked_.begin(), blocked_.end()), blocked_.end());
    if (!copies.empty()) take_over(copies);
    return {std::move(is_in_use_), std::move(blocked_)};
  }

 private:
  bool wraps_hexes() const { return !choice_.hex_to_sheet.empty(); }
  bool is_used(int sheet) const {
    return sheet >= 0 && is_in_use_[static_cast<std::size_t>(sheet)] != 0;
  }
  int sheet_behind(QuadId q) const { return choice_.hex_to_sheet[state_.quad_face[q.index()].hex]; }
  /// Of a sheet vertex; those of one sheet are all it has.
  std::size_t sheet_of(VertId v) const {
    int sheet = SheetChoice::kNone;
    for (QuadId q : marked_.graph.quads(v)) sheet = std::max(sheet, choice_.quad_to_sheet[q]);
    if (wraps_hexes())
      for (const HexCorner& corner : state_.vert_to_hex[v])
        sheet = std::max(sheet, choice_.hex_to_sheet[corner.hex]);
    return static_cast<std::size_t>(sheet);
  }
  void block(VertId v) {
    is_in_use_[sheet_of(v)] = 0;
    blocked_.push_back(v);
  }
  bool is_covered(QuadId q) const { return is_used(choice_.quad_to_sheet[q]); }
  /// Keeps its vertices where a sheet passes; the others go with the copies.
  bool is_in(QuadId q) const {
    return is_covered(q) || (wraps_hexes() && !is_used(sheet_behind(q)));
  }
  VertId moved(VertId v) const { return copy_[v].is_valid() ? copy_[v] : v; }

  /// Plans every vertex of the sheets; a sheet with a vertex that cannot be planned fails.
  void plan_all() {
    plan_of_.resize(state_.num_verts());
    collect_sheet();
    std::vector<VertId> failed, passable;  // sheets stay in use until all vertices are seen alike
    for (VertId v : sheet_.verts) {
      const auto plan = plan_copy(v);
      (plan ? passable : failed).push_back(v);
      if (plan) plan_of_[v] = *plan;
    }
    for (VertId v : failed) block(v);
    make_visible(state_, sheet_, passable, kLeastCosine);
    find_directions();
  }

  /// Those from which the sheet is seen; the quads beside it may be seen from behind.
  void find_directions() {
    const auto normals = collect_normals();
    for (std::size_t i = 0; i < sheet_.verts.size(); ++i) {
      const VisibleDirection visible = find_visible_direction(normals[i]);
      plan_of_[sheet_.verts[i]].direction = visible.direction;
      if (visible.cosine < kLeastCosine) block(sheet_.verts[i]);
    }
  }

  /// The faces of the sheets in use as one sheet (of several components).
  void collect_sheet() {
    sheet_ = {};
    for (QuadId q : marks_.quad_to_region.ids())
      if (is_covered(q)) add_face(state_.quad_face[q.index()]);
    if (wraps_hexes()) collect_inner_faces();
    sheet_.verts = sheet_verts(sheet_.quads);
    sheet_.depth = kDepth;
    for (VertId v : sheet_.verts) sheet_.directions.push_back(plan_of_[v].direction);
  }

  void collect_inner_faces() {
    is_in_set_.assign(state_.mesh.num_hexes(), 0);
    for (HexId h : state_.mesh.hexes.ids())
      if (is_used(choice_.hex_to_sheet[h])) is_in_set_[h.index()] = 1;
    for (HexId h : state_.mesh.hexes.ids()) {
      if (is_in_set_[h.index()] == 0) continue;
      for (int lf = 0; lf < 6; ++lf) {
        const HexId other = state_.neighbors.neighbor[h][static_cast<std::size_t>(lf)];
        if (other.is_valid() && is_in_set_[other.index()] == 0) add_face({h, lf});
      }
    }
  }

  void add_face(const HexFace& face) {
    sheet_.quads.push_back(face_verts(state_.mesh, face));
    sheet_.behind.push_back(face.hex);
  }

  /// Of the sheet's faces at each of its vertices.
  std::vector<std::vector<Vec3>> collect_normals() const {
    std::vector<std::vector<Vec3>> normals(sheet_.verts.size());
    const auto& positions = state_.mesh.positions;
    for (const auto& quad : sheet_.quads)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto it = std::lower_bound(sheet_.verts.begin(), sheet_.verts.end(), quad[k]);
        const Vec3& o = positions[quad[k]];
        const Vec3 a = positions[quad[(k + 1) % 4]] - o, b = positions[quad[(k + 3) % 4]] - o;
        normals[static_cast<std::size_t>(it - sheet_.verts.begin())].push_back(
            normalized(cross(a, b)));
      }
    return normals;
  }

  /// Absent where the sheet or its rim cannot pass.
  std::optional<CopyPlan> plan_copy(VertId v) {
    if (state_.move[v] != MoveIn::Space) return {};
    if (wraps_hexes() && !check_.is_manifold(v, is_in_set_)) return {};
    if (marked_.graph.quads(v).empty()) return CopyPlan{};  // inside the mesh
    return plan_place(v);
  }

  std::optional<CopyPlan> plan_place(VertId v) const {
    const QuadFans fans = find_quad_fans(marked_, v, [&](QuadId q) { return is_in(q); });
    if (fans.num_inside != 1 || fans.num_outside > 1 || fans.marked_outside.size() > 1) return {};
    CopyPlan plan;
    if (fans.num_outside == 0) return plan;
    if (!fans.marked_outside.empty()) return plan_curve_copy(v, fans.marked_outside[0]);
    plan.kind = VertKind::Surface;
    for (QuadId q : marked_.graph.quads(v))
      if (!is_in(q)) plan.patch = marks_.region_to_patch[marks_.quad_to_region[q]];
    return plan;
  }

  /// The rim leaves a corner along a curve of the other side, or crosses a curve: the copy lies on
  /// that curve, between the vertex and the next one.
  std::optional<CopyPlan> plan_curve_copy(VertId v, BoundaryEdgeId e) const {
    CopyPlan plan;
    plan.kind = VertKind::Curve;
    plan.curve = marked_.edge_to_curve[e];
    const FeatureCurve& curve = features_.curves[plan.curve];
    const VertId next = marked_.graph.edge(e).other(v);
    const double length = curve.length();
    const bool is_corner = state_.kind[v] == VertKind::Corner;
    if (!is_corner && (state_.kind[v] != VertKind::Curve || state_.curve[v] != plan.curve))
      return {};
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
    plan.arc = kCornerShare * here + (1 - kCornerShare) * there;
    return plan;
  }

  void take_over(const std::vector<VertId>& copies) {
    copy_.assign(state_.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies.size(); ++i) copy_[sheet_.verts[i]] = copies[i];
    std::vector<QuadLabel> labels = label_quads();
    label_rim(labels);
    move_edges();
    write_copies();
    state_.rebuild();
    restore_regions(state_, std::move(labels), marks_);
  }

  std::vector<QuadLabel> label_quads() const {
    std::vector<QuadLabel> labels;
    for (QuadId q : marks_.quad_to_region.ids()) {
      auto verts = state_.quads[q.index()];
      if (!is_in(q))
        for (VertId& v : verts) v = moved(v);
      labels.push_back({sorted_verts(verts), marks_.quad_to_region[q]});
    }
    return labels;
  }

  void label_rim(std::vector<QuadLabel>& labels) const {
    for (std::size_t i = 0; i < marked_.graph.num_edges(); ++i) {
      const auto& edge = marked_.graph.edge(BoundaryEdgeId(i));
      if (edge.num_quads != 2 || is_in(edge.quads[0]) == is_in(edge.quads[1])) continue;
      const QuadId outer = is_in(edge.quads[0]) ? edge.quads[1] : edge.quads[0];
      labels.push_back({sorted_verts({edge.a, edge.b, moved(edge.a), moved(edge.b)}),
                        marks_.quad_to_region[outer]});
    }
  }

  /// Curves stay with the originals where they bound the sheet, follow the copies elsewhere, and
  /// gain the edge from a corner to a copy on a curve.
  void move_edges() {
    for (LabeledEdge& edge : marks_.edges) {
      const auto& quads = marked_.graph.edge(marked_.graph.find_edge(edge.verts[0], edge.verts[1]));
      if (is_in(quads.quads[0]) || is_in(quads.quads[1])) continue;
      for (VertId& v : edge.verts) v = moved(v);
      std::sort(edge.verts.begin(), edge.verts.end());
    }
    for (VertId v : sheet_.verts)
      if (plan_of_[v].kind == VertKind::Curve)
        marks_.edges.push_back({{v, copy_[v]}, plan_of_[v].curve});
    std::sort(marks_.edges.begin(), marks_.edges.end(),
              [](const LabeledEdge& x, const LabeledEdge& y) { return x.verts < y.verts; });
  }

  void write_copies() {
    state_.resize_arrays();
    for (VertId v : sheet_.verts) {
      const VertId w = copy_[v];
      const CopyPlan& plan = plan_of_[v];
      state_.kind[w] = plan.kind;
      state_.patch[w] = plan.patch;
      state_.curve[w] = plan.curve;
      state_.arc[w] = plan.arc;
      state_.target[w] = state_.target[v];
      state_.direction[w] = state_.direction[v];
    }
  }

  FitState& state_;
  FeatureMarks& marks_;
  const FeatureGraph& features_;
  const WrapChoice& choice_;
  std::vector<char> is_in_use_;  // per sheet: has not failed
  std::vector<VertId> blocked_;
  MarkedGraph marked_;
  SetCheck check_;
  std::vector<char> is_in_set_;         // per hex that a sheet wraps; empty when none is
  Sheet sheet_;                         // of all sheets in use
  IdVector<VertId, CopyPlan> plan_of_;  // of the vertices of chosen quads
  IdVector<VertId, VertId> copy_;       // invalid off the sheets
};

}  // namespace

std::vector<char> extrude_regions(FitState& state, FeatureMarks& marks,
                                  const FeatureGraph& features, const SheetChoice& choice) {
  return Extrusion(state, marks, features, quads_of_regions(marks, choice)).run().is_done;
}

WrapOutcome wrap_hexes(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
                       const WrapChoice& choice) {
  return Extrusion(state, marks, features, choice).run();
}

}  // namespace hexwright::fitting
