// Sums run over fixed chunks in order (base/parallel.h), so the average has the same bits for any
// number of threads.
#include "dual/quality_of_hex.h"

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_shape.h"

namespace hexwright::dual {

MeshQuality measure_quality(const HexMesh& mesh) {
  const auto map = [&](std::size_t begin, std::size_t end) {
    MeshQuality part;
    for (std::size_t h = begin; h < end; ++h) {
      const double s = scaled_jacobian(mesh.corners(HexId(h)));
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
