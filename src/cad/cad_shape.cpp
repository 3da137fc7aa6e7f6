// Points of the exact shape by way of the triangles and polylines that stand for it.
#include "hexwright/cad/cad_shape.h"

#include <limits>
#include <utility>
#include <vector>

#include "hexwright/geometry/surface_tree.h"

#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

/// Normals of a mesh's vertex and of the face it is for agree by so much.
constexpr double kLeastCosine = 0.3;

/// A piece of an edge's polyline.
struct Segment {
  Vec3 a, b;
  CadEdgeId edge;
};

/// Segments as flat triangles: the tree of triangles finds the nearest.
TriMesh as_triangles(const std::vector<Segment>& segments) {
  TriMesh mesh;
  for (const Segment& s : segments) {
    const VertId a = mesh.positions.push_back(s.a), b = mesh.positions.push_back(s.b);
    mesh.tris.push_back({a, b, b});
  }
  return mesh;
}

class CadShape final : public ExactShape {
 public:
  CadShape(const CadModel& model, std::vector<Segment> segments)
      : tree_(model.surface),
        tri_to_face_(model.tri_to_face),
        segments_(std::move(segments)),
        segment_tree_(as_triangles(segments_)),
        projector_(model.projector) {
    for (const VertId v : model.verts) corners_.push_back(model.surface.positions[v]);
  }

  std::optional<ExactPoint> on_surface(const Vec3& p, const Vec3& normal) const override {
    ClosestFilter filter;
    if (normal != Vec3{}) {
      filter.normal = normal;
      filter.min_cosine = kLeastCosine;
    }
    auto nearest = tree_.closest(p, filter);
    if (!nearest) nearest = tree_.closest(p);
    if (!nearest) return {};
    auto found = projector_->to_face(tri_to_face_[nearest->tri], p);
    if (found && dot(found->direction, tree_.normal(nearest->tri)) < 0)
      found->direction = -found->direction;
    return found;
  }

  std::optional<ExactPoint> on_curve(const Vec3& p) const override {
    if (segments_.empty()) return {};
    const auto nearest = segment_tree_.closest(p);
    if (!nearest) return {};
    return projector_->to_edge(segments_[nearest->tri.index()].edge, p);
  }

  std::optional<Vec3> on_corner(const Vec3& p) const override {
    std::optional<Vec3> best;
    for (const Vec3& corner : corners_)
      if (!best || norm_sq(corner - p) < norm_sq(*best - p)) best = corner;
    return best;
  }

 private:
  SurfaceTree tree_;
  IdVector<TriId, CadFaceId> tri_to_face_;
  std::vector<Segment> segments_;
  SurfaceTree segment_tree_;
  std::vector<Vec3> corners_;
  std::shared_ptr<const Projector> projector_;
};

/// Edges between faces of different patches, and sharp ones.
bool is_followed(const CadEdge& edge, const CadSurface& surface) {
  if (edge.kind == CadEdgeClass::Sharp || edge.kind == CadEdgeClass::Open) return true;
  return edge.kind == CadEdgeClass::Tangent &&
         surface.face_to_patch[edge.faces[0]] != surface.face_to_patch[edge.faces[1]];
}

}  // namespace

std::shared_ptr<const ExactShape> make_exact_shape(const CadModel& model,
                                                   const CadSurface& surface) {
  std::vector<Segment> segments;
  const auto& x = model.surface.positions;
  for (const CadEdgeId e : model.edges.ids()) {
    const CadEdge& edge = model.edges[e];
    if (!is_followed(edge, surface)) continue;
    for (std::size_t k = 1; k < edge.verts.size(); ++k)
      segments.push_back({x[edge.verts[k - 1]], x[edge.verts[k]], e});
  }
  return std::make_shared<CadShape>(model, std::move(segments));
}

}  // namespace hexwright
