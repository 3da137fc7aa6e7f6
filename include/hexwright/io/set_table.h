// The named sets of a hex mesh: regions, patches, curves and corners, as every writer sees them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

enum class SetKind {
  Region,      ///< hexes with one tag
  Patch,       ///< labelled quads of one patch
  PatchGroup,  ///< the quads of "wall.1", "wall.2" ... together, as "wall"
  Curve,       ///< labelled edges of one curve
  Corners      ///< all labelled corners
};

struct NamedSet {
  SetKind kind = SetKind::Region;
  std::string name;
  /// Region tag, patch or curve; -1 for quads and edges without one, and for other kinds.
  std::int32_t number = -1;
  /// Increasing indices of hexes, or into labels.quads, labels.edges, labels.corners.
  std::vector<std::size_t> members;
  bool is_given = false;  ///< the name is the mesh's own
};

/// Sets are in increasing order of number; none is empty.
struct SetTable {
  std::vector<NamedSet> regions, patches, patch_groups, curves, corners;

  /// The set of this number among `sets`, which must be there.
  static const NamedSet& at(const std::vector<NamedSet>& sets, std::int32_t number);
};

/// Names are the mesh's; sets without one are called REGION_2 (REGION_MINUS_2 for a negative tag),
/// PATCH_3, CURVE_4 or, without a number, PATCH_NONE, CURVE_NONE; the corners are CORNERS.
SetTable make_set_table(const HexMesh& mesh);

/// The name of a set that has none of its own.
std::string default_set_name(SetKind kind, std::int32_t number);

/// Whether a group unites this patch with others.
bool is_in_group(const NamedSet& patch, const NamedSet& group);
/// The name of a region, patch or curve: the mesh's own, or else the default one.
std::string set_name(const HexMesh& mesh, SetKind kind, std::int32_t number);

/// The vertices of a set's elements, increasing, each once.
std::vector<VertId> set_nodes(const HexMesh& mesh, const NamedSet& set);

/// The faces of hexes that have these vertices, in (hex, lf) order: two for a quad inside the mesh.
std::vector<HexFace> find_quad_faces(const HexMesh& mesh, const VertToHex& vert_to_hex,
                                     const std::array<VertId, 4>& quad);

/// The hex and local face of every labelled quad: the first in (hex, lf) order for an inner one.
/// Throws Error{BadArgument} for a quad that is no face of any hex.
std::vector<HexFace> find_quad_sides(const HexMesh& mesh);

/// What a format allows a set to be called.
struct NameRules {
  std::size_t max_length = 200;            ///< bytes, with `suffix`
  bool (*is_allowed)(char) = nullptr;      ///< others become '_'; null: all but controls
  bool starts_with_letter = false;         ///< else "s_" is put in front
  bool ignores_case = false;               ///< "Inlet" and "inlet" are the same name
  bool is_upper_case = false;              ///< letters are written as capitals
  bool is_unique_per_kind = false;         ///< a region and a patch may share a name
  std::string_view suffix;                 ///< patches also take this name with it behind
  std::vector<std::string_view> reserved;  ///< names that mean something else there
};

/// A name that a format could not take as it was.
struct ChangedName {
  std::string given, written;
  friend bool operator==(const ChangedName&, const ChangedName&) = default;
};

/// Makes all names of a table fit a format: letters replaced, lengths cut, "_2", "_3" behind names
/// that are taken. Names of users come before those of sets without one. Returns what changed, in
/// the order of the table.
std::vector<ChangedName> apply_name_rules(const NameRules& rules, SetTable& table);

/// For NameRules::is_allowed.
bool is_word_letter(char c);          ///< A-Z a-z 0-9 _
bool is_word_letter_or_mark(char c);  ///< also . and -

}  // namespace hexwright
