// Plans the copies (what each becomes on the boundary), inserts the sheet, rewrites the marks.
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
};

class Extrusion {
 public:
  Extrusion(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
            const IdVector<RegionId, char>& is_chosen)
      : state_(state),
        marks_(marks),
        features_(features),
        is_chosen_(is_chosen),
        marked_(state, marks) {}

  bool run() {
    collect_quads();
    if (sheet_.quads.empty() || !plan_copies()) return false;
    const auto copies = insert_sheet(state_.mesh, state_.vert_to_hex, sheet_, {}, kMinJacobian);
    if (copies.empty()) return false;
    copy_.assign(marked_.graph.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies.size(); ++i) copy_[sheet_.verts[i]] = copies[i];
    std::vector<QuadLabel> labels = label_quads();
    label_rim(labels);
    move_edges();
    write_copies();
    state_.rebuild();
    restore_regions(state_, std::move(labels), marks_);
    return true;
  }

 private:
  bool is_in(QuadId q) const { return is_chosen_[marks_.quad_to_region[q]] != 0; }
  VertId moved(VertId v) const { return copy_[v].is_valid() ? copy_[v] : v; }

  void collect_quads() {
    for (QuadId q : marks_.quad_to_region.ids()) {
      if (!is_in(q)) continue;
      sheet_.quads.push_back(face_verts(state_.mesh, state_.quad_face[q.index()]));
      sheet_.behind.push_back(state_.quad_face[q.index()].hex);
    }
    sheet_.verts = sheet_verts(sheet_.quads);
    sheet_.depth = kDepth;
  }

  bool plan_copies() {
    for (VertId v : sheet_.verts) {
      const VisibleDirection visible = direction_at(v);
      const auto plan = plan_copy(v);
      if (!plan || visible.cosine < kLeastCosine || state_.move[v] != MoveIn::Space) return false;
      sheet_.directions.push_back(visible.direction);
      plans_.push_back(*plan);
    }
    return true;
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

  /// Absent where the rim cannot pass.
  std::optional<CopyPlan> plan_copy(VertId v) const {
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
    for (std::size_t i = 0; i < plans_.size(); ++i)
      if (plans_[i].kind == VertKind::Curve)
        marks_.edges.push_back({{sheet_.verts[i], copy_[sheet_.verts[i]]}, plans_[i].curve});
    std::sort(marks_.edges.begin(), marks_.edges.end(),
              [](const LabeledEdge& x, const LabeledEdge& y) { return x.verts < y.verts; });
  }

  void write_copies() {
    state_.resize_arrays();
    for (std::size_t i = 0; i < plans_.size(); ++i) {
      const VertId v = sheet_.verts[i], w = copy_[v];
      state_.kind[w] = plans_[i].kind;
      state_.patch[w] = plans_[i].patch;
      state_.curve[w] = plans_[i].curve;
      state_.arc[w] = plans_[i].arc;
      state_.target[w] = state_.target[v];
      state_.direction[w] = state_.direction[v];
    }
  }

  FitState& state_;
  FeatureMarks& marks_;
  const FeatureGraph& features_;
  const IdVector<RegionId, char>& is_chosen_;
  MarkedGraph marked_;
  Sheet sheet_;
  std::vector<CopyPlan> plans_;    // per sheet vertex
  IdVector<VertId, VertId> copy_;  // invalid off the sheet
};

}  // namespace

bool extrude_regions(FitState& state, FeatureMarks& marks, const FeatureGraph& features,
                     const IdVector<RegionId, char>& is_chosen) {
  return Extrusion(state, marks, features, is_chosen).run();
}

}  // namespace hexwright::fitting
