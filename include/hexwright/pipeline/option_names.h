// What the choices of options are called: on the command line, in Python, and in reports.
#pragma once

#include <cstddef>
#include <optional>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

template <class Enum>
struct NamedChoice {
  const char* name;
  Enum value;
};

inline constexpr NamedChoice<Sizing> kSizingNames[] = {{"deviation", Sizing::Deviation},
                                                       {"thickness", Sizing::Thickness}};
inline constexpr NamedChoice<Pairing> kPairingNames[] = {{"blocks", Pairing::Blocks},
                                                         {"none", Pairing::None},
                                                         {"octree", Pairing::Octree},
                                                         {"sheets", Pairing::Sheets}};
inline constexpr NamedChoice<Balance> kBalanceNames[] = {{"auto", Balance::Auto},
                                                         {"relaxed", Balance::Relaxed},
                                                         {"strong", Balance::Strong},
                                                         {"weak", Balance::Weak}};
inline constexpr NamedChoice<Side> kSideNames[] = {
    {"both", Side::Both}, {"inside", Side::Inside}, {"outside", Side::Outside}};
inline constexpr NamedChoice<Padding> kPaddingNames[] = {{"everywhere", Padding::Everywhere},
                                                         {"selective", Padding::Selective}};
inline constexpr NamedChoice<PatchVerts> kPatchVertsNames[] = {
    {"balanced", PatchVerts::Balanced}, {"on-surface", PatchVerts::OnSurface}};
inline constexpr NamedChoice<Parts> kPartsNames[] = {
    {"as-is", Parts::AsIs}, {"separate", Parts::Separate}, {"unite", Parts::Unite}};
inline constexpr NamedChoice<Placement> kPlacementNames[] = {{"as-given", Placement::AsGiven},
                                                             {"faces", Placement::Faces}};
inline constexpr NamedChoice<std::optional<DualMode>> kDualModeNames[] = {
    {"auto", std::nullopt}, {"blocks", DualMode::Blocks}, {"sheets", DualMode::Sheets}};

/// What a value is called; "" when it is none of those named.
template <class Enum, std::size_t N>
constexpr const char* name_of(const NamedChoice<Enum> (&names)[N], const Enum& value) {
  for (const NamedChoice<Enum>& choice : names)
    if (choice.value == value) return choice.name;
  return "";
}

}  // namespace hexwright
