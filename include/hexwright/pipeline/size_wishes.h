// What users ask of the sizes of cells and of the domain around an object, in the surface's unit.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/vec3.h"
#include "hexwright/geometry/side.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// A length in the surface's unit, or a share of the diagonal of its box.
struct Length {
  double value = 0;  ///< 0 = not given
  bool is_share = false;
  bool is_given() const { return value > 0; }
  double in(double diagonal) const { return is_share ? value * diagonal : value; }
};

inline constexpr int kMostAcross = 100, kMostCells = 100'000'000;  ///< largest wishes

/// Cells near a place are no larger than a size.
struct SizeRule {
  enum class Where { Box, Ball, Cylinder, Patch, Curve, Near };
  Where where = Where::Box;
  Vec3 a, b;            ///< Box: corners; Ball: centre; Cylinder: ends of the axis
  double radius = 0;    ///< Ball, Cylinder
  std::string pattern;  ///< Patch, Curve: of whole names (base/name_pattern.h)
  std::shared_ptr<const TriMesh> surface;  ///< Near: the triangles that are meant
  Length size;
  Length distance;   ///< the size holds this far around the place
  std::string text;  ///< as it was given, for messages
};

/// Room around the object, per side: a length, or a multiple of the object's longest side.
struct Margin {
  double value = 0;
  bool is_multiple = false;
};

struct SizeWishes {
  Length size;        ///< an upper bound everywhere; cells are at most one level finer
  Length max_size;    ///< an upper bound; finer wherever the surface asks for it
  Length min_size;    ///< no finer cells
  double growth = 0;  ///< largest ratio of neighbouring sizes over distance; 0 = any
  int across = 0;     ///< cells across the thickness of the solid, at least; 0 = any
  int cells = 0;      ///< find the size that gives about so many hexes; 0 = not
  std::vector<SizeRule> rules;
  std::optional<Box3> box;                      ///< the domain around the object
  std::optional<std::array<Margin, 6>> margin;  ///< -x, +x, -y, +y, -z, +z

  bool has_domain() const { return box || margin; }
  /// Whether anything is asked of cells' sizes.
  bool any() const;
};

/// "2", "0.5", "1%". Throws Error{BadArgument}.
Length parse_length(const std::string& text);

/// Reads WHERE=SIZE or WHERE=SIZE,DISTANCE, with lengths as above and WHERE one of
///   box:X0,Y0,Z0,X1,Y1,Z1   ball:X,Y,Z,R   cylinder:X0,Y0,Z0,X1,Y1,Z1,R
///   patch:NAME   curve:NAME   near:FILE
/// NAME is a pattern of names (base/name_pattern.h). Files are read at once. Throws
/// Error{BadArgument} that says what is wrong and shows a right form, and what read_surface throws.
SizeRule parse_size_rule(const std::string& text);

/// "X0,Y0,Z0,X1,Y1,Z1" with positive extents.
Box3 parse_box(const std::string& text);

/// One, three (x, y, z) or six margins (-x, +x, -y, ...): "5L" is five times the object's longest
/// side, "0.3" a length.
std::array<Margin, 6> parse_margin(const std::string& text);

/// The wishes of a file in JSON: keys are the names of options, "refine" a list of rules as text.
///   {"size": "2%", "growth": 1.3, "refine": ["box:0,0,0,1,1,1=0.1", "patch:wall.*=0.2,0.5"]}
/// Adds to the wishes. Throws Error{BadFile} that names the file and the key.
void read_size_wishes(const std::string& path, SizeWishes& wishes);

/// Refuses wishes that contradict each other with a sentence that names both. `diagonal`: of the
/// surface's box.
void check_size_wishes(const SizeWishes& wishes, Side side, double diagonal);

}  // namespace hexwright
