// Faces are triangulated one by one; along an edge all of them have the same points, which are the
// model's vertices: so the surface of a solid is watertight however its faces were divided.
#include "cad/occt/build_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <BRepAdaptor_Curve2d.hxx>
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include "hexwright/base/error.h"

#include "cad/occt/exact_face.h"
#include "cad/occt/occt.h"

namespace hexwright::cad {
namespace {

/// Shares of an edge at which the angle of its faces is measured; its ends, where normals may be
/// doubtful, are not among them.
constexpr double kProbes[] = {0.1, 0.3, 0.5, 0.7, 0.9};

class OcctProjector final : public Projector {
 public:
  std::optional<ExactPoint> to_face(CadFaceId face, const Vec3& p) const override {
    try {
      return faces[face].project(p);
    } catch (const Standard_Failure&) {
      return {};
    }
  }
  std::optional<ExactPoint> to_edge(CadEdgeId edge, const Vec3& p) const override {
    try {
      return edges[edge] ? edges[edge]->project(p) : std::nullopt;
    } catch (const Standard_Failure&) {
      return {};
    }
  }

  IdVector<CadFaceId, ExactFace> faces;
  IdVector<CadEdgeId, std::optional<ExactEdge>> edges;
};

class ModelBuilder {
 public:
  ModelBuilder(const Document& document, const CadReadOptions& options)
      : document_(document), options_(options), projector_(std::make_shared<OcctProjector>()) {
    model_.format = document.format;
    model_.unit = document.unit;
  }

  CadModel run(const std::vector<TopoDS_Shape>& solids) {
    triangulate(solids);
    for (const TopoDS_Shape& solid : solids) add_solid(solid);
    if (model_.surface.num_tris() == 0)
      throw Error(ErrorCode::BadGeometry,
                  "none of the faces can be triangulated; repair the solid in the CAD program");
    if (num_failed_ > 0)
      model_.warnings.push_back(std::to_string(num_failed_) +
                                " faces could not be triangulated and leave holes; repair them in "
                                "the CAD program if the mesh is wrong there");
    std::sort(model_.verts.begin(), model_.verts.end());
    model_.projector = projector_;
    return std::move(model_);
  }

 private:
  void triangulate(const std::vector<TopoDS_Shape>& solids) {
    Bnd_Box box;
    for (const TopoDS_Shape& solid : solids) BRepBndLib::Add(solid, box, false);
    const double diagonal = box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
    if (!(diagonal > 0) || !std::isfinite(diagonal))
      throw Error(ErrorCode::BadGeometry,
                  "the solid has no extent; check what was exported and its unit");
    IMeshTools_Parameters parameters;
    parameters.Deflection = options_.deflection * diagonal;
    parameters.Angle = options_.angular_deflection;
    parameters.InParallel = false;
    for (const TopoDS_Shape& solid : solids) BRepMesh_IncrementalMesh(solid, parameters);
  }

  void add_solid(const TopoDS_Shape& solid) {
    const CadSolidId id = model_.solids.push_back({document_.info_of(solid).name});
    vert_map_.Clear();
    vert_ids_.clear();
    edge_map_.Clear();
    edge_chains_.clear();
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(solid, TopAbs_FACE, faces);
    const std::size_t first = model_.faces.size();
    for (int i = 1; i <= faces.Extent(); ++i) add_face(TopoDS::Face(faces(i)), id);
    TopTools_IndexedDataMapOfShapeListOfShape edge_to_faces;
    TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, edge_to_faces);
    for (int i = 1; i <= edge_to_faces.Extent(); ++i)
      add_edge(TopoDS::Edge(edge_to_faces.FindKey(i)), edge_to_faces(i), faces, first);
    for (const VertId v : vert_ids_) model_.verts.push_back(v);
  }

  /// The model's vertex at the end of an edge.
  VertId vert_of(const TopoDS_Vertex& vertex, const Vec3& fallback) {
    const int known = vert_map_.Extent();
    const int index = vert_map_.Add(vertex);
    if (index > known)
      vert_ids_.push_back(model_.surface.positions.push_back(
          vertex.IsNull() ? fallback : to_vec3(BRep_Tool::Pnt(vertex))));
    return vert_ids_[static_cast<std::size_t>(index - 1)];
  }

  /// The vertices along an edge, made when its first face comes.
  const std::vector<VertId>& chain_of(const TopoDS_Edge& edge, const std::vector<Vec3>& points) {
    const int known = edge_map_.Extent();
    const int index = edge_map_.Add(edge);
    if (index <= known) return edge_chains_[static_cast<std::size_t>(index - 1)];
    const auto forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    TopoDS_Vertex first, last;
    TopExp::Vertices(forward, first, last);
    std::vector<VertId> chain;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool is_first = k == 0 && !first.IsNull();
      const bool is_last = k + 1 == points.size() && !last.IsNull();
      if (BRep_Tool::Degenerated(edge) && !first.IsNull())
        chain.push_back(vert_of(first, points[k]));
      else
        chain.push_back(is_first  ? vert_of(first, points[k])
                        : is_last ? vert_of(last, points[k])
                                  : model_.surface.positions.push_back(points[k]));
    }
    edge_chains_.push_back(std::move(chain));
    return edge_chains_.back();
  }

  void add_face(const TopoDS_Face& face, CadSolidId solid) {
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    CadFace result;
    const PartInfo info = document_.info_of(face);
    result.name = info.name;
    result.layer = info.layer;
    result.color = info.color;
    result.solid = solid;
    std::vector<SurfaceSample> samples;
    if (!mesh.IsNull())
      for (int i = 1; i <= mesh->NbNodes(); ++i) {
        const gp_Pnt p = mesh->Node(i).Transformed(place.Transformation());
        const gp_Pnt2d uv = mesh->HasUVNodes() ? mesh->UVNode(i) : gp_Pnt2d();
        samples.push_back({to_vec3(p), uv.X(), uv.Y()});
      }
    if (!mesh.IsNull()) add_triangles(face, place, mesh, samples, result);
    num_failed_ += mesh.IsNull();
    const ExactFace& exact =
        projector_->faces[projector_->faces.push_back(ExactFace(face, std::move(samples)))];
    exact.describe(result);
    model_.faces.push_back(std::move(result));
  }

  void add_triangles(const TopoDS_Face& face, const TopLoc_Location& place,
                     const Handle(Poly_Triangulation) & mesh,
                     const std::vector<SurfaceSample>& samples, CadFace& result) {
    std::vector<VertId> node_to_vert(samples.size());
    for (TopExp_Explorer it(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); it.More(); it.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(it.Current());
      const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
      if (polygon.IsNull()) continue;
      std::vector<Vec3> points;
      for (int k = 1; k <= polygon->NbNodes(); ++k)
        points.push_back(samples[static_cast<std::size_t>(polygon->Node(k) - 1)].point);
      const std::vector<VertId>& chain = chain_of(edge, points);
      if (chain.size() != points.size()) continue;  // left open; the surface's preparation welds
      for (std::size_t k = 0; k < chain.size(); ++k)
        node_to_vert[static_cast<std::size_t>(polygon->Node(static_cast<int>(k) + 1) - 1)] =
            chain[k];
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (!node_to_vert[i].is_valid())
        node_to_vert[i] = model_.surface.positions.push_back(samples[i].point);
    const bool is_turned = face.Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      std::array<int, 3> n;
      mesh->Triangle(i).Get(n[0], n[1], n[2]);
      if (is_turned) std::swap(n[1], n[2]);
      std::array<VertId, 3> tri;
      for (std::size_t k = 0; k < 3; ++k) tri[k] = node_to_vert[static_cast<std::size_t>(n[k] - 1)];
      if (tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0]) continue;  // at a pole
      const TriId t = model_.surface.tris.push_back(tri);
      model_.tri_to_face.push_back(CadFaceId(model_.faces.size()));
      const auto p = model_.surface.corners(t);
      result.area += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    }
  }

  void add_edge(const TopoDS_Edge& edge, const TopTools_ListOfShape& faces,
                const TopTools_IndexedMapOfShape& face_map, std::size_t first_face) {
    const int index = edge_map_.FindIndex(edge);
    if (BRep_Tool::Degenerated(edge) || index == 0) return;
    CadEdge result;
    result.verts = edge_chains_[static_cast<std::size_t>(index - 1)];
    result.name = document_.info_of(edge).name;
    std::vector<TopoDS_Face> sides;
    for (const TopoDS_Shape& face : faces)
      if (sides.empty() || !sides.back().IsSame(face)) sides.push_back(TopoDS::Face(face));
    for (std::size_t k = 0; k < std::min<std::size_t>(2, sides.size()); ++k)
      result.faces[k] =
          CadFaceId(first_face + static_cast<std::size_t>(face_map.FindIndex(sides[k]) - 1));
    classify(edge, sides, result);
    model_.edges.push_back(std::move(result));
    projector_->edges.push_back(make_exact(edge, model_.edges[CadEdgeId(model_.edges.size() - 1)]));
  }

  void classify(const TopoDS_Edge& edge, const std::vector<TopoDS_Face>& sides,
                CadEdge& result) const {
    if (sides.size() == 2) {
      result.angle = largest_angle(edge, sides, result);
      result.kind =
          result.angle > options_.sharp_angle ? CadEdgeClass::Sharp : CadEdgeClass::Tangent;
      return;
    }
    const bool is_seam = sides.size() == 1 && BRep_Tool::IsClosed(edge, sides[0]);
    result.kind = is_seam ? CadEdgeClass::Seam : CadEdgeClass::Open;
  }

  double largest_angle(const TopoDS_Edge& edge, const std::vector<TopoDS_Face>& sides,
                       const CadEdge& result) const {
    double first, last, largest = 0;
    BRep_Tool::Range(edge, first, last);
    for (const double share : kProbes) {
      std::array<std::optional<Vec3>, 2> normals;
      for (std::size_t k = 0; k < 2; ++k) {
        double u0, u1;
        const auto curve = BRep_Tool::CurveOnSurface(edge, sides[k], u0, u1);
        if (curve.IsNull()) continue;
        const gp_Pnt2d uv = curve->Value(u0 + share * (u1 - u0));
        normals[k] = projector_->faces[result.faces[k]].normal(uv.X(), uv.Y());
      }
      if (normals[0] && normals[1])
        largest =
            std::max(largest, std::acos(std::clamp(dot(*normals[0], *normals[1]), -1.0, 1.0)));
    }
    return largest;
  }

  /// Absent for edges without a curve in space. Samples are spread evenly over its parameters,
  /// eight for each of the polyline's points.
  static std::optional<ExactEdge> make_exact(const TopoDS_Edge& edge, const CadEdge& result) {
    double first, last;
    if (BRep_Tool::Curve(edge, first, last).IsNull() || result.verts.size() < 2) return {};
    const BRepAdaptor_Curve curve(edge);
    const int count = 8 * static_cast<int>(result.verts.size());
    std::vector<CurveSample> samples;
    for (int k = 0; k <= count; ++k) {
      const double t = first + (last - first) * k / count;
      samples.push_back({to_vec3(curve.Value(t)), t});
    }
    return ExactEdge(edge, std::move(samples));
  }

  const Document& document_;
  const CadReadOptions& options_;
  CadModel model_;
  std::shared_ptr<OcctProjector> projector_;
  // Of the solid at hand; the index of a map is that of the vector, from 1.
  TopTools_IndexedMapOfShape vert_map_, edge_map_;
  std::vector<VertId> vert_ids_;
  std::vector<std::vector<VertId>> edge_chains_;
  std::size_t num_failed_ = 0;
};

}  // namespace

CadModel build_model(const Document& document, const std::vector<TopoDS_Shape>& solids,
                     const CadReadOptions& options) {
  return ModelBuilder(document, options).run(solids);
}

}  // namespace hexwright::cad
