// The pillow's working structure: plain arrays that only ever grow. An inserted layer redirects
// links of older hexes but never removes one, so ids stay valid for the caps that refer to them.
#include "dual/complex/hex_complex.h"

#include <algorithm>

namespace hexwright::dual {

void HexComplex::reserve(std::size_t count) {
  verts.reserve(count);
  links.reserve(count);
  places.reserve(count);
}

HexId HexComplex::add_hex() {
  links.push_back({});
  places.push_back({});
  return verts.push_back({});
}

// Domains have few planes; a list is searched faster than anything else.
int HexComplex::find_or_add_plane(const DomainPlane& plane) {
  const auto found = std::find(planes.begin(), planes.end(), plane);
  if (found != planes.end()) return static_cast<int>(found - planes.begin());
  planes.push_back(plane);
  return static_cast<int>(planes.size() - 1);
}

void HexComplex::connect(HexId a, int lf_a, HexId b, int lf_b) {
  links[a][lf_a] = FaceLink::to_face(b, lf_b);
  links[b][lf_b] = FaceLink::to_face(a, lf_a);
}

namespace {

// Do the two faces hold the same vertices in opposite cyclic order?
bool faces_match(const HexComplex& c, HexId a, int lf_a, HexId b, int lf_b) {
  const auto vert = [&](HexId h, int lf, int k) { return c.verts[h][kHexFaces[lf][(k + 8) % 4]]; };
  for (int shift = 0; shift < 4; ++shift) {
    bool same = true;
    for (int k = 0; k < 4; ++k) same &= vert(a, lf_a, k) == vert(b, lf_b, shift - k);
    if (same) return true;
  }
  return false;
}

}  // namespace

// A link must be mutual, lead to another hex, and join faces of the same vertices. Quads that share
// two edges are looked for elsewhere (double_links.h).
std::optional<Issue> HexComplex::find_problem() const {
  for (HexId h : verts.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const FaceLink link = links[h][lf];
      if (link.is_plane()) continue;
      const bool mutual = links[link.hex()][link.lf()] == FaceLink::to_face(h, lf);
      if (!mutual || link.hex() == h || !faces_match(*this, h, lf, link.hex(), link.lf()))
        return Issue{"hex " + std::to_string(h.value()) + " face " + std::to_string(lf) +
                     " does not fit the hex behind it"};
    }
  return std::nullopt;
}

}  // namespace hexwright::dual
