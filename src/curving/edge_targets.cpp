// The middle of a chord goes to the closest point of what its edge belongs to.
#include "curving/edge_targets.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

#include "mesh/quad.h"

namespace hexwright::curving {
namespace {

/// A point farther from the chord than this share of its length is none of the edge's: the chord of
/// a half circle is as far from its arc.
constexpr double kFarthest = 0.5;

/// An exact point that is farther from the triangles' belongs to something else.
constexpr double kFarthestExact = 0.1;

/// Per edge, what the labels say.
struct EdgeLabel {
  CurveId curve;
  PatchId patch;  ///< invalid between two patches: anywhere
  bool is_on_surface = false;
  Vec3 normal;  ///< sum of the unit normals of the quads, outwards of the object
};

class Labeler {
 public:
  Labeler(const HexMesh& mesh, Side side)
      : mesh_(mesh), table_(mesh), labels_(mesh.mid_nodes->edges.size()), side_(side) {}

  IdVector<EdgeId, EdgeLabel> run() {
    for (const LabeledQuad& quad : mesh_.labels.quads)
      if (quad.patch.is_valid()) add_quad(quad);
    for (const LabeledEdge& edge : mesh_.labels.edges)
      if (const EdgeId e = table_.find(edge.verts[0], edge.verts[1]); e.is_valid())
        labels_[e].curve = edge.curve;
    return std::move(labels_);
  }

 private:
  void add_quad(const LabeledQuad& quad) {
    const auto& v = quad.verts;
    Vec3 normal = quad_normal(mesh_.positions, v);
    if (side_ == Side::Outside) normal = -normal;
    for (std::size_t k = 0; k < 4; ++k) {
      const EdgeId e = table_.find(v[k], v[(k + 1) % 4]);
      if (!e.is_valid()) continue;
      EdgeLabel& label = labels_[e];
      label.patch = label.is_on_surface && label.patch != quad.patch ? PatchId() : quad.patch;
      label.is_on_surface = true;
      label.normal += normal;
    }
  }

  const HexMesh& mesh_;
  EdgeTable table_;
  IdVector<EdgeId, EdgeLabel> labels_;
  Side side_;
};

struct Chord {
  Vec3 a, b;
  Vec3 middle() const { return 0.5 * a + 0.5 * b; }
  double length() const { return distance(a, b); }
};

class Seeker {
 public:
  explicit Seeker(const CurvingTarget& target) : target_(target) {}

  /// Absent when nothing is near.
  std::optional<Vec3> find(const EdgeLabel& label, const Chord& chord) const {
    const auto found = label.curve.is_valid() && label.curve.index() < curves().size()
                           ? on_curve(curves()[label.curve], chord)
                           : on_surface(label, chord);
    if (!found || distance(*found, chord.middle()) > kFarthest * chord.length()) return {};
    return found;
  }

 private:
  const IdVector<CurveId, FeatureCurve>& curves() const { return target_.parts.features.curves; }

  /// Between the curve's points at the ends of the chord, the shorter way on a loop.
  std::optional<Vec3> on_curve(const FeatureCurve& curve, const Chord& chord) const {
    const TriMesh& surface = target_.tree.surface();
    double from = closest_on_curve(surface, curve, chord.a).arc;
    double to = closest_on_curve(surface, curve, chord.b).arc;
    if (from > to) std::swap(from, to);
    if (curve.is_closed && to - from > 0.5 * curve.length()) {
      std::swap(from, to);
      to += curve.length();
    }
    if (!(to > from)) return {};
    return closest_on_curve(surface, curve, chord.middle(), from, to).point;
  }

  std::optional<Vec3> on_surface(const EdgeLabel& label, const Chord& chord) const {
    ClosestFilter filter;
    filter.max_distance = kFarthest * chord.length();
    filter.normal = normalized(label.normal);
    filter.min_cosine = 0.3;
    filter.patch = label.patch;
    filter.patches = &target_.parts.patches;
    auto found = target_.tree.closest(chord.middle(), filter);
    if (!found) {  // of a divided patch, or among triangles that face elsewhere
      filter.patch = {};
      found = target_.tree.closest(chord.middle(), filter);
    }
    if (!found) return {};
    return found->point;
  }

  const CurvingTarget& target_;
};

/// The point of the exact shape near a target; the target itself where there is none.
Vec3 put_on_exact(const CurvingTarget& target, const EdgeLabel& label, EdgeKind kind,
                  const Vec3& point) {
  const Vec3 p = target.frame.to_world(point);
  const Vec3 normal = target.frame.pose.apply_inverse(normalized(label.normal));
  const auto found =
      kind == EdgeKind::Curve ? target.exact->on_curve(p) : target.exact->on_surface(p, normal);
  return found ? target.frame.to_unit(found->point) : point;
}

}  // namespace

EdgeTargets find_edge_targets(const HexMesh& mesh, const CurvingTarget& target) {
  const auto labels = Labeler(mesh, target.side).run();
  const auto verts = edge_verts(mesh);
  const Seeker seeker(target);
  EdgeTargets targets{IdVector<EdgeId, EdgeKind>(labels.size(), EdgeKind::Inner),
                      IdVector<EdgeId, Vec3>(labels.size())};
  parallel_for(
      labels.size(),
      [&](std::size_t i) {
        const EdgeId e(i);
        const EdgeLabel& label = labels[e];
        if (!label.is_on_surface) return;
        const Chord chord = {mesh.positions[verts[e][0]], mesh.positions[verts[e][1]]};
        const auto found = seeker.find(label, chord);
        targets.kind[e] = !found                   ? EdgeKind::Unmatched
                          : label.curve.is_valid() ? EdgeKind::Curve
                                                   : EdgeKind::Surface;
        if (found) targets.offset[e] = *found - chord.middle();
      },
      64);
  if (!target.exact) return targets;
  for (EdgeId e : labels.ids()) {  // one by one, as an exact shape asks for
    check_cancelled();
    if (targets.kind[e] != EdgeKind::Curve && targets.kind[e] != EdgeKind::Surface) continue;
    const Chord chord = {mesh.positions[verts[e][0]], mesh.positions[verts[e][1]]};
    const Vec3 near = chord.middle() + targets.offset[e];
    const Vec3 exact = put_on_exact(target, labels[e], targets.kind[e], near);
    if (distance(exact, near) <= kFarthestExact * chord.length())
      targets.offset[e] = exact - chord.middle();
  }
  return targets;
}

}  // namespace hexwright::curving
