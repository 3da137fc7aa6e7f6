// Plans the copies (what each becomes on the boundary), inserts the sheets, rewrites the marks. A
// sheet that does not fit is left out and the others are inserted without it, so that a batch costs
// one rebuild of the adjacency however many of its sheets fail.
#include "fit/extrude_regions.h"

#include <algorithm>
#include <optional>

#include "fit/quad_fans.h"
#include "fit/visible_normal.h"

namespace hexwright::fitting {
namespace {

constexpr double kDepth = 0.3;
constexpr double kLeastCosine = 0.01;
constexpr double kMinJacobian = 1e-6;
constexpr double kCornerShare = 0.65;  // of a copy's parameter between a corner and the next vertex

/// What the copy of a sheet vertex becomes.
struct CopyPlan {
  VertKind kind = VertKind::Interior;
  PatchId patch;
  CurveId curve;
  double arc = 0;
  Vec3 direction;  ///< away from the copy, unit; sees the chosen quads
};

class Extrusion {
 public:
  Extrusion(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
            const SheetChoice& choice)
      : state_(state),
        marks_(marks),
        features_(features),
        choice_(choice),
        is_in_use_(choice.num_sheets, 1),
        marked_(state, marks) {}

  std::vector<char> run() {
    plan_all();
    std::vector<VertId> copies;
    while (copies.empty()) {
      collect_sheet();
      if (sheet_.quads.empty()) return is_in_use_;
      SheetInsertion insertion =
          insert_sheet(state_.mesh, state_.vert_to_hex, sheet_, {}, kMinJacobian);
      copies = std::move(insertion.copies);
      for (VertId v : insertion.stuck) is_in_use_[sheet_of(v)] = 0;
    }
    copy_.assign(marked_.graph.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies.size(); ++i) copy_[sheet_.verts[i]] = copies[i];
    std::vector<QuadLabel> labels = label_quads();
    label_rim(labels);
    move_edges();
    write_copies();
    state_.rebuild();
    restore_regions(state_, std::move(labels), marks_);
    return is_in_use_;
  }

 private:
  int sheet_of(QuadId q) const { return choice_.region_to_sheet[marks_.quad_to_region[q]]; }
  /// Of a vertex of a chosen quad; those of one sheet are all it has.
  std::size_t sheet_of(VertId v) const {
    int sheet = SheetChoice::kNone;
    for (QuadId q : marked_.graph.quads(v)) sheet = std::max(sheet, sheet_of(q));
    return static_cast<std::size_t>(sheet);
  }
  bool is_in(QuadId q) const {
    const int sheet = sheet_of(q);
    return sheet >= 0 && is_in_use_[static_cast<std::size_t>(sheet)] != 0;
  }
  VertId moved(VertId v) const { return copy_[v].is_valid() ? copy_[v] : v; }

  /// Plans every vertex of the chosen quads; a sheet with a vertex that cannot be planned fails.
  void plan_all() {
    plan_of_.resize(marked_.graph.num_verts());
    collect_sheet();
    std::vector<std::size_t> failed;  // sheets stay in use until all vertices are seen alike
    for (VertId v : sheet_.verts) {
      if (const auto plan = plan_copy(v))
        plan_of_[v] = *plan;
      else
        failed.push_back(sheet_of(v));
    }
    for (std::size_t sheet : failed) is_in_use_[sheet] = 0;
  }

  /// The quads of the sheets in use as one sheet (of several components).
  void collect_sheet() {
    sheet_ = {};
    for (QuadId q : marks_.quad_to_region.ids()) {
      if (!is_in(q)) continue;
      sheet_.quads.push_back(face_verts(state_.mesh, state_.quad_face[q.index()]));
      sheet_.behind.push_back(state_.quad_face[q.index()].hex);
    }
    sheet_.verts = sheet_verts(sheet_.quads);
    sheet_.depth = kDepth;
    for (VertId v : sheet_.verts) sheet_.directions.push_back(plan_of_[v].direction);
  }

  /// Sees the chosen quads at a vertex; the others may be seen from behind.
  VisibleDirection direction_at(VertId v) const {
    std::vector<Vec3> normals;
    const Vec3& o = state_.mesh.positions[v];
    for (QuadId q : marked_.graph.quads(v)) {
      if (!is_in(q)) continue;
      const auto quad = face_verts(state_.mesh, state_.quad_face[q.index()]);
      const auto k =
          static_cast<std::size_t>(std::find(quad.begin(), quad.end(), v) - quad.begin());
      const Vec3 a = state_.mesh.positions[quad[(k + 1) % 4]] - o;
      const Vec3 b = state_.mesh.positions[quad[(k + 3) % 4]] - o;
      normals.push_back(normalized(cross(a, b)));
    }
    return find_visible_direction(normals);
  }

  /// Absent where the rim cannot pass, or nothing sees the chosen quads.
  std::optional<CopyPlan> plan_copy(VertId v) const {
    const VisibleDirection visible = direction_at(v);
    if (visible.cosine < kLeastCosine || state_.move[v] != MoveIn::Space) return {};
    auto plan = plan_place(v);
    if (plan) plan->direction = visible.direction;
    return plan;
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

  /// The rim leaves a corner along a curve of the other side: the copy lies on that curve, between
  /// the corner and the next vertex.
  std::optional<CopyPlan> plan_curve_copy(VertId v, BoundaryEdgeId e) const {
    if (state_.kind[v] != VertKind::Corner) return {};
    CopyPlan plan;
    plan.kind = VertKind::Curve;
    plan.curve = marked_.edge_to_curve[e];
    const FeatureCurve& curve = features_.curves[plan.curve];
    const VertId next = marked_.graph.edge(e).other(v);
    const double length = curve.length();
    bool is_start = curve.verts.front() == state_.feature_point[v];
    if (curve.verts.front() == curve.verts.back())
      is_start = state_.kind[next] == VertKind::Corner || state_.arc[next] < 0.5 * length;
    const double here = is_start ? 0 : length;
    const double there = state_.kind[next] == VertKind::Corner ? length - here : state_.arc[next];
    plan.arc = kCornerShare * here + (1 - kCornerShare) * there;
    return plan;
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
  const SheetChoice& choice_;
  std::vector<char> is_in_use_;  // per sheet: has not failed
  MarkedGraph marked_;
  Sheet sheet_;                         // of all sheets in use
  IdVector<VertId, CopyPlan> plan_of_;  // of the vertices of chosen quads
  IdVector<VertId, VertId> copy_;       // invalid off the sheets
};

}  // namespace

std::vector<char> extrude_regions(FitState& state, FeatureMarks& marks,
                                  const FeatureGraph& features, const SheetChoice& choice) {
  return Extrusion(state, marks, features, choice).run();
}

}  // namespace hexwright::fitting
