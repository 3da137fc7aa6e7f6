// Names for parts of a surface by rule: "inlet=plane:x<0.001", for bodies without names.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// One condition; a point meets it where `signed_distance` is not positive.
struct PatchCondition {
  enum class Kind { HalfSpace, Plane, Box, Sphere, Cylinder, Normal, Angle, File, CadFace };
  Kind kind = Kind::HalfSpace;
  Vec3 a;  ///< half-space, plane: normal; box: low corner; sphere: centre; cylinder: a point
           ///< of the axis; Normal: direction, unit; Angle: where the patch lies
  Vec3 b;  ///< box: high corner; cylinder: direction of the axis, unit
  double value = 0;  ///< half-space, plane: offset along `a`; radius; Normal, Angle: least cosine
  std::string path;  ///< File: to be read into `surface` by the caller
  TriMesh surface;   ///< File: the triangles that are meant
  /// CadFace: "cylinder" and other kinds of surfaces, with `value` the radius where it is above 0;
  /// or "face", with a pattern of names (base/name_pattern.h).
  std::string face_kind, face_name;
  /// CadFace: groups of the surface that are such faces; filled by the caller (find_faces).
  std::vector<std::int32_t> groups;
};

/// All conditions must be met.
struct PatchRule {
  std::string name;
  std::vector<PatchCondition> conditions;
};

/// Reads NAME=CONDITION, or several conditions joined by '&':
///   plane:x<0.1   plane:y>2   plane:z=0     a side of a plane across an axis, or the plane itself
///   box:X0,Y0,Z0,X1,Y1,Z1                   inside a box
///   sphere:X,Y,Z,R                          inside a sphere
///   cylinder:X,Y,Z,AX,AY,AZ,R               within R of the axis through a point
///   normal:NX,NY,NZ;20deg                   faces this way, within an angle (default 1 degree)
///   angle:X,Y,Z;30deg                       all that is reached from the triangle nearest to a
///   point
///                                           across edges that turn by at most that (default 30)
///   file:PATH                               lies on the surface of a file
/// and of a CAD file's faces, by what they are:
///   cylinder:r=5   sphere:r=5   torus:r=2   (the small radius)   kind:cone   face:NAME
/// Throws Error{BadArgument} that says what is wrong and shows a right form.
PatchRule parse_patch_rule(const std::string& text);

struct RuledSurface {
  TriMesh surface;                       ///< with groups by the rules
  std::vector<std::size_t> num_matched;  ///< per rule: triangles named by it
};

/// Names triangles by the first rule that their centroid meets; others keep their group. Borders of
/// boxes, planes, spheres and cylinders are imprinted: triangles that cross them are divided, edges
/// first where a curved border needs shorter ones. Vertices within 1e-4 of the surface's diagonal
/// from a border count as on it. Copies of a vertex stay copies: the surface may be unwelded.
RuledSurface apply_patch_rules(const TriMesh& surface, std::span<const PatchRule> rules);

}  // namespace hexwright
