#include "relax/state/proof.h"

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

namespace hexwright::relax {
namespace {

bool is_proven(const HexMesh& mesh, HexId h) {
  return check_positivity(mesh.corners(h)) == Positivity::Positive;
}

}  // namespace

std::vector<HexId> find_unproven(const HexMesh& mesh) {
  std::vector<char> proven(mesh.num_hexes());
  parallel_for(
      mesh.num_hexes(), [&](std::size_t h) { proven[h] = is_proven(mesh, HexId(h)); }, 256);
  std::vector<HexId> unproven;
  for (std::size_t h = 0; h < proven.size(); ++h)
    if (!proven[h]) unproven.push_back(HexId(h));
  return unproven;
}

int count_unproven_around(const Body& body, VertId v) {
  int count = 0;
  for (const HexCorner& corner : body.vert_to_hex[v]) count += !is_proven(body.mesh, corner.hex);
  return count;
}

}  // namespace hexwright::relax
