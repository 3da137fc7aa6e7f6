// The least over a hex's corners needs each of its edges twice; here each is normalised once.
#include "hexwright/mesh/hex_shape.h"

#include <cstdint>

namespace hexwright {
namespace {

// A corner's edge vector as an edge of kHexEdges and the direction to run it in.
struct SignedEdge {
  std::uint8_t edge = 0;
  double sign = 1;
};
using CornerEdges = std::array<std::array<SignedEdge, 3>, 8>;

constexpr CornerEdges make_corner_edges() {
  CornerEdges table{};
  for (std::size_t lv = 0; lv < 8; ++lv)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t e = 0; e < 12; ++e) {
        const int to = kHexCornerNeighbors[lv][k];
        const int from = static_cast<int>(lv);
        if (kHexEdges[e] == std::array<int, 2>{from, to})
          table[lv][k] = {static_cast<std::uint8_t>(e), 1.0};
        if (kHexEdges[e] == std::array<int, 2>{to, from})
          table[lv][k] = {static_cast<std::uint8_t>(e), -1.0};
      }
  return table;
}
constexpr CornerEdges kCornerEdges = make_corner_edges();

}  // namespace

double scaled_jacobian(const std::array<Vec3, 8>& p) {
  std::array<Vec3, 12> unit;  // every edge normalised once, and used by both of its corners
  for (std::size_t e = 0; e < 12; ++e) {
    unit[e] = p[kHexEdges[e][1]] - p[kHexEdges[e][0]];
    const double length = norm(unit[e]);
    if (!(length > 0)) return -1;
    unit[e] *= 1 / length;
  }
  double least = 1;
  for (const auto& c : kCornerEdges) {
    const double value = det(unit[c[0].edge], unit[c[1].edge], unit[c[2].edge]);
    least = std::min(least, c[0].sign * c[1].sign * c[2].sign * value);
  }
  return std::max(least, -1.0);
}

double hex_volume(const std::array<Vec3, 8>& p) {
  // A bilinear face halves the space between its two triangulations, so that its flux is their
  // mean. Positions relative to a corner keep the digits of a hex far from the origin.
  double sum = 0;
  for (const auto& f : kHexFaces) {
    const Vec3 a = p[f[0]] - p[0];
    const Vec3 b = p[f[1]] - p[0];
    const Vec3 c = p[f[2]] - p[0];
    const Vec3 d = p[f[3]] - p[0];
    sum += det(a, b, c) + det(a, c, d) + det(a, b, d) + det(b, c, d);
  }
  return sum / 12;
}

}  // namespace hexwright
