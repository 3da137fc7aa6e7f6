// Sums run over fixed chunks in order (base/parallel.h), so the average has the same bits for any
// number of threads.
#include "dual/quality_of_hex.h"

#include "hexwright/base/parallel.h"

namespace hexwright::dual {

namespace {

// Determinant of the edges at a corner, and the product of their squared lengths.
struct Corner {
  double det, lengths_sq;
};

// kHexCornerNeighbors is ordered so that a right-handed corner has a positive determinant.
Corner corner_of(const std::array<Vec3, 8>& p, int lv) {
  const auto& n = kHexCornerNeighbors[lv];
  const Vec3 e0 = p[n[0]] - p[lv], e1 = p[n[1]] - p[lv], e2 = p[n[2]] - p[lv];
  return {det(e0, e1, e2), norm_sq(e0) * norm_sq(e1) * norm_sq(e2)};
}

}  // namespace

// The least over the corners of det / product of edge lengths: 1 for a cube, <= 0 when inverted. An
// edge of length zero counts as inverted.
double scaled_jacobian(const HexMesh& mesh, HexId h) {
  const auto p = mesh.corners(h);
  double least = 1;
  for (int lv = 0; lv < 8; ++lv) {
    const Corner c = corner_of(p, lv);
    const double lengths = std::sqrt(c.lengths_sq);
    least = std::min(least, lengths > 0 ? c.det / lengths : -1.0);
  }
  return least;
}

// The power mean with exponent -8, smooth where the least is not: within 8^(1/8) = 1.3 of it. See
// docs/algorithms/dual.md, "Raising the mean". Square roots only: pow() differs between platforms.
double soft_scaled_jacobian(const HexMesh& mesh, HexId h) {
  const auto p = mesh.corners(h);
  double mean = 0;  // of s^-8
  for (int lv = 0; lv < 8; ++lv) {
    const Corner c = corner_of(p, lv);
    if (c.det <= 0) return 0;
    const double inverse_sq = c.lengths_sq / (c.det * c.det);
    const double inverse_4th = inverse_sq * inverse_sq;
    mean += 0.125 * inverse_4th * inverse_4th;
  }
  return 1 / std::sqrt(std::sqrt(std::sqrt(mean)));
}

MeshQuality measure_quality(const HexMesh& mesh) {
  const auto map = [&](std::size_t begin, std::size_t end) {
    MeshQuality part;
    for (std::size_t h = begin; h < end; ++h) {
      const double s = scaled_jacobian(mesh, HexId(h));
      part.min = std::min(part.min, s);
      part.avg += s;
      part.num_inverted += s <= 0;
    }
    return part;
  };
  const auto combine = [](MeshQuality a, const MeshQuality& b) {
    a.min = std::min(a.min, b.min);
    a.avg += b.avg;
    a.num_inverted += b.num_inverted;
    return a;
  };
  MeshQuality total = parallel_reduce(mesh.num_hexes(), MeshQuality{}, map, combine);
  if (mesh.num_hexes() > 0) total.avg /= static_cast<double>(mesh.num_hexes());
  return total;
}

}  // namespace hexwright::dual
