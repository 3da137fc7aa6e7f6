// Names and descriptions of faces; which files are CAD files.
#include "hexwright/cad/cad_model.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "hexwright/cad/read_cad.h"

namespace hexwright {
namespace {

/// Rounding of directions and of places that files bring along.
constexpr double kAlong = 1e-9;

double tidy(double value, double scale) { return std::abs(value) < 1e-9 * scale ? 0 : value; }

std::string say_place(const Vec3& p) {
  const double scale = std::max({1.0, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", tidy(p.x, scale), tidy(p.y, scale),
                     tidy(p.z, scale));
}

/// The coordinate axis along a direction, or -1.
int axis_along(const Vec3& direction) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(std::abs(direction[axis]) - 1) < kAlong) return axis;
  return -1;
}

std::string say_plane(const CadFace& face) {
  const int axis = axis_along(face.axis);
  const double scale = std::max(1.0, norm(face.origin));
  if (axis >= 0) return fmt::format("plane {}={:.6g}", "xyz"[axis], tidy(face.origin[axis], scale));
  return fmt::format("plane across {} through {}", say_place(face.axis), say_place(face.origin));
}

std::string say_axis(const CadFace& face) {
  const int axis = axis_along(face.axis);
  if (axis < 0)
    return fmt::format("along {} through {}", say_place(face.axis), say_place(face.origin));
  Vec3 foot = face.origin;
  foot[axis] = 0;
  return fmt::format("along {} through {}", "xyz"[axis], say_place(foot));
}

}  // namespace

std::string describe_face(const CadFace& face) {
  switch (face.kind) {
    case CadSurfaceKind::Plane:
      return say_plane(face);
    case CadSurfaceKind::Cylinder:
      return fmt::format("cylinder r={:.6g} {}", face.radius, say_axis(face));
    case CadSurfaceKind::Cone:
      return fmt::format("cone of {:.4g} degrees {}", std::abs(face.minor) * 180 / std::numbers::pi,
                         say_axis(face));
    case CadSurfaceKind::Sphere:
      return fmt::format("sphere r={:.6g} about {}", face.radius, say_place(face.origin));
    case CadSurfaceKind::Torus:
      return fmt::format("torus R={:.6g} r={:.6g} {}", face.radius, face.minor, say_axis(face));
    case CadSurfaceKind::Spline:
      return "spline";
    default:
      return "other surface";
  }
}

std::string default_face_name(CadFaceId face) { return fmt::format("face_{}", face.value() + 1); }

bool is_cad_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {".step", ".stp", ".p21", ".iges", ".igs", ".brep"})
    if (extension == known) return true;
  std::string head(64, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("ISO-10303-21;") != std::string::npos ||
         head.find("DBRep_DrawableShape") != std::string::npos;
}

}  // namespace hexwright
