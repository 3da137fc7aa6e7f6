// Local numbering of a hexahedron: VTK's vertex order, used everywhere in memory and in files.
//
//          7--------6            faces (outward, counter-clockwise seen from outside)
//         /|       /|              0: -x   1: +x   2: -y   3: +y   4: -z   5: +z
//        4--------5 |            edges: 0-3 bottom ring, 4-7 top ring, 8-11 vertical
//        | |      | |
//        | 3------|-2            z  y
//        |/       |/             | /
//        0--------1              |/___ x
#pragma once

#include <array>

namespace hexwright {

/// Local vertices of each face, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> kHexFaces = {{
    {0, 4, 7, 3},  // -x
    {1, 2, 6, 5},  // +x
    {0, 1, 5, 4},  // -y
    {3, 7, 6, 2},  // +y
    {0, 3, 2, 1},  // -z
    {4, 5, 6, 7},  // +z
}};

/// Local vertices of each edge.
inline constexpr std::array<std::array<int, 2>, 12> kHexEdges = {{
    {0, 1},
    {1, 2},
    {3, 2},
    {0, 3},
    {4, 5},
    {5, 6},
    {7, 6},
    {4, 7},
    {0, 4},
    {1, 5},
    {2, 6},
    {3, 7},
}};

/// The three edge neighbours of each local vertex, ordered so that their edge vectors form a
/// right-handed frame: det(p[n0]-p[v], p[n1]-p[v], p[n2]-p[v]) > 0 for the unit cube.
inline constexpr std::array<std::array<int, 3>, 8> kHexCornerNeighbors = {{
    {1, 3, 4},
    {2, 0, 5},
    {3, 1, 6},
    {0, 2, 7},
    {7, 5, 0},
    {4, 6, 1},
    {5, 7, 2},
    {6, 4, 3},
}};

/// Local vertex at the corner with bits (x, y, z) = (b & 1, b >> 1 & 1, b >> 2 & 1), and back.
inline constexpr std::array<int, 8> kHexVertexOfBits = {0, 1, 3, 2, 4, 5, 7, 6};
inline constexpr std::array<int, 8> kHexBitsOfVertex = {0, 1, 3, 2, 4, 5, 7, 6};

/// Face opposite to each face.
constexpr int opposite_hex_face(int lf) { return lf ^ 1; }

}  // namespace hexwright
