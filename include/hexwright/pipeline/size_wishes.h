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
#include "hexwright/io/point_field.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// A length in the surface's unit, or a share of the diagonal of its box, or in a unit of its own.
struct Length {
  double value = 0;  ///< 0 = not given
  bool is_share = false;
  double metres = 0;  ///< length of the unit that it was given in; 0 = the surface's
  bool is_given() const { return value > 0; }
  double in(double diagonal) const { return is_share ? value * diagonal : value; }
};

inline constexpr int kMostAcross = 100, kMostCells = 100'000'000;  ///< largest wishes

/// Cells near a place are no larger than a size.
struct SizeRule {
  enum class Where { Box, Ball, Cylinder, Patch, Curve, Region, Near, Field };
  Where where = Where::Box;
  Vec3 a, b;            ///< Box: corners; Ball: centre; Cylinder: ends of the axis
  double radius = 0;    ///< Ball, Cylinder
  std::string pattern;  ///< Patch, Curve, Region: of whole names (base/name_pattern.h)
  /// Near: the triangles that are meant; Region: those around it, absent while it is a name.
  std::shared_ptr<const TriMesh> surface;
  bool is_outside = false;  ///< Region: what is not in the surface
  /// Field: sizes in the surface's unit, above 0; nothing is asked where they are infinite. A cell
  /// keeps to the least at the field's points in it, its corners and centre, and the middles of its
  /// edges and faces. Inside, where no other size is given, the lattice is made for the least that
  /// is found in the surface's box.
  std::shared_ptr<const PointField> field;
  bool is_at_surface = false;  ///< Field: it holds for cells that may meet the surface
  Length size;                 ///< none for a field
  Length distance;             ///< the size holds this far around the place
  std::string text;            ///< as it was given, for messages
};

/// Room around the object, per side: a length, or a multiple of the object's longest side.
struct Margin {
  double value = 0;
  bool is_multiple = false;
  double metres = 0;  ///< as of Length
};

struct SizeWishes {
  double unit = 0;    ///< the surface's, in metres; 0 = nobody knows
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

/// "2", "0.5", "2mm", "1%". Throws Error{BadArgument}.
Length parse_length(const std::string& text);

/// Reads WHERE=SIZE or WHERE=SIZE,DISTANCE, with lengths as above and WHERE one of
///   box:X0,Y0,Z0,X1,Y1,Z1   ball:X,Y,Z,R   cylinder:X0,Y0,Z0,X1,Y1,Z1,R
///   patch:NAME   curve:NAME   region:NAME   near:FILE   inside:FILE
/// or field:FILE, field:FILE=ARRAY, whose point data are sizes in the surface's unit. NAME is a
/// pattern of names (base/name_pattern.h); `inside` and `outside` are regions of every object.
/// Files are read at once. Throws Error{BadArgument} that says what is wrong and shows a right
/// form, and what read_surface and read_point_field throw.
SizeRule parse_size_rule(const std::string& text);

/// "X0,Y0,Z0,X1,Y1,Z1" with positive extents.
Box3 parse_box(const std::string& text);

/// One, three (x, y, z) or six margins (-x, +x, -y, ...): "5L" is five times the object's longest
/// side, "0.3" and "300mm" are lengths.
std::array<Margin, 6> parse_margin(const std::string& text);

/// The wishes of a file in JSON: keys are the names of options, and values what the options take,
/// "refine" a list of rules.
///   {"size": "2%", "growth": 1.3, "refine": ["box:0,0,0,1,1,1=0.1", "patch:wall.*=0.2,0.5"]}
/// Adds to the wishes. Throws Error{BadFile} that names the file and the key.
void read_size_wishes(const std::string& path, SizeWishes& wishes);

/// Refuses wishes that contradict each other with a sentence that names both. `diagonal`: of the
/// surface's box.
void check_size_wishes(const SizeWishes& wishes, Side side, double diagonal);

}  // namespace hexwright
