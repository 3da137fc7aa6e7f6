// The order of nodes in Gmsh's hexahedra of second order.
//
// Based on: Geuzaine, Remacle, "Gmsh reference manual", section "Node ordering": "Hexahedron20" and
// "Hexahedron27".
#pragma once

#include <array>
#include <cstddef>

namespace hexwright::io {

/// For each node of the format, which of ours it is (see QuadraticHex).
inline constexpr std::array<std::size_t, 27> kGmshHexOrder = {
    0,  1,  2,  3,  4,  5,  6,  7,                   // corners
    8,  11, 16, 9,  17, 10, 18, 19, 12, 15, 13, 14,  // edges 01 03 04 12 15 23 26 37 45 47 56 67
    24, 22, 20, 21, 23, 25,                          // faces -z -y -x +x +y +z
    26};

}  // namespace hexwright::io
