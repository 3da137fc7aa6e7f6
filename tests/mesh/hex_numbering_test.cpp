// Recomputes every table of hex_numbering.h from the geometry of the unit cube.
#include "hexwright/mesh/hex_numbering.h"

#include <gtest/gtest.h>

#include "helpers.h"

namespace hexwright {
namespace {

const HexMesh kCube = test::box_hex_mesh(1, 1, 1);

TEST(HexNumbering, FacesPointOutwardsAlongTheirAxis) {
  const auto p = kCube.corners(HexId(0));
  for (int lf = 0; lf < 6; ++lf) {
    const auto& f = kHexFaces[static_cast<std::size_t>(lf)];
    const Vec3 normal = cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
    Vec3 expected;
    expected[lf / 2] = lf % 2 == 0 ? -1 : 1;
    EXPECT_EQ(normal, expected) << "face " << lf;
  }
}

TEST(HexNumbering, CornerFramesAreRightHanded) {
  const auto p = kCube.corners(HexId(0));
  for (int lv = 0; lv < 8; ++lv) {
    const auto& n = kHexCornerNeighbors[static_cast<std::size_t>(lv)];
    EXPECT_EQ(det(p[n[0]] - p[lv], p[n[1]] - p[lv], p[n[2]] - p[lv]), 1.0) << "corner " << lv;
  }
}

TEST(HexNumbering, EdgesHaveUnitLengthAndAreDistinct) {
  const auto p = kCube.corners(HexId(0));
  std::set<std::pair<int, int>> seen;
  for (const auto& e : kHexEdges) {
    EXPECT_EQ(distance(p[e[0]], p[e[1]]), 1.0);
    seen.insert(std::minmax(e[0], e[1]));
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST(HexNumbering, VertexBitsAreTheCoordinates) {
  const auto p = kCube.corners(HexId(0));
  for (int b = 0; b < 8; ++b) {
    const int lv = kHexVertexOfBits[static_cast<std::size_t>(b)];
    EXPECT_EQ(p[lv], (Vec3{double(b & 1), double(b >> 1 & 1), double(b >> 2 & 1)}));
    EXPECT_EQ(kHexBitsOfVertex[static_cast<std::size_t>(lv)], b);
  }
}

}  // namespace
}  // namespace hexwright
