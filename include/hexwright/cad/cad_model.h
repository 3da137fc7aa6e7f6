// What a CAD file holds, free of the library that reads it: triangles that know their faces, edges
// as polylines, names, and a way back to the exact geometry.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/geometry/exact_shape.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

using CadFaceId = Id<struct CadFaceTag>;    ///< face of a CAD model
using CadEdgeId = Id<struct CadEdgeTag>;    ///< edge of a CAD model
using CadSolidId = Id<struct CadSolidTag>;  ///< solid of a CAD model

enum class CadSurfaceKind { Plane, Cylinder, Cone, Sphere, Torus, Spline, Other };

using CadColor = std::array<std::uint8_t, 3>;  ///< red, green, blue as screens show them

struct CadFace {
  std::string name;   ///< in the file; "" for none
  std::string layer;  ///< "" for none
  std::optional<CadColor> color;
  CadSolidId solid;
  CadSurfaceKind kind = CadSurfaceKind::Other;
  Vec3 origin;        ///< a point of the plane or the axis; the centre of sphere and torus
  Vec3 axis;          ///< unit: normal of a plane, axis of the others; zero for none
  double radius = 0;  ///< of cylinder, sphere and, at the origin, cone; the torus's large one
  double minor = 0;   ///< torus: the small radius; cone: half its opening angle, radians
  double area = 0;    ///< of its triangles
};

/// How the faces meet along an edge.
enum class CadEdgeClass {
  Sharp,    ///< at an angle, see CadReadOptions::sharp_angle
  Tangent,  ///< smoothly
  Seam,     ///< a face with itself, as along a full cylinder
  Open      ///< one face only, or more than two
};

struct CadEdge {
  std::string name;  ///< in the file; "" for none
  std::array<CadFaceId, 2> faces;
  CadEdgeClass kind = CadEdgeClass::Sharp;
  double angle = 0;           ///< largest between the two outward normals, radians
  std::vector<VertId> verts;  ///< of the surface, from end to end; a loop repeats its first
};

struct CadSolid {
  std::string name;  ///< of the part or the body; "" for none
};

/// Back to the exact geometry. Not safe from several threads at once.
class Projector {
 public:
  virtual ~Projector() = default;
  /// The point nearest to p of the surface that carries a face (it may lie a little beyond the
  /// face's border), with the normal of the face's outer side. Absent where the search fails.
  virtual std::optional<ExactPoint> to_face(CadFaceId face, const Vec3& p) const = 0;
  /// The point nearest to p of an edge, with the tangent there.
  virtual std::optional<ExactPoint> to_edge(CadEdgeId edge, const Vec3& p) const = 0;
};

/// All lengths are millimetres, whatever the file's unit; files that name none are taken as they
/// are.
struct CadModel {
  /// Closed solid by solid, without groups: faces share the vertices of their edges.
  TriMesh surface;
  IdVector<TriId, CadFaceId> tri_to_face;
  IdVector<CadFaceId, CadFace> faces;
  IdVector<CadEdgeId, CadEdge> edges;
  IdVector<CadSolidId, CadSolid> solids;
  std::vector<VertId> verts;  ///< of the surface, where edges end
  std::string format;         ///< "STEP", "IGES" or "BREP"
  std::string unit;           ///< the file's: "millimetre", "inch" ...; "" where it names none
  std::vector<std::string> notes, warnings;
  std::shared_ptr<const Projector> projector;
};

/// "plane z=0", "cylinder r=5 along z through (1, 2, 0)", "torus R=10 r=2 ...".
std::string describe_face(const CadFace& face);

/// "face_12": what a face without a name is called; faces count from 1 in the file's order.
std::string default_face_name(CadFaceId face);

}  // namespace hexwright
