// In a box every lattice vertex has one, two, four or eight octants: all creases are clipped, and
// each vertex becomes one hex between the centres of its cells, the boundary's planes taking the
// place of cells that are missing.
#include "dual/complex/base_mesh.h"

namespace hexwright::dual {

namespace {

// A box of lattice points with x fastest.
struct IndexBox {
  std::array<std::int32_t, 3> size;
  std::int32_t operator()(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return (z * size[1] + y) * size[0] + x;
  }
  std::int32_t operator()(const LatticeCoord& p) const { return (*this)(p[0], p[1], p[2]); }
};

}  // namespace

// Lattice vertex p of 0..n per axis is a hex between mesh vertices p and p + 1 of 0..n+1: the
// cells' centres and one boundary layer on either side.
void build_box_base(const Domain& domain, HexComplex& complex) {
  IndexBox hexes, verts;
  for (int a = 0; a < 3; ++a) {
    hexes.size[a] = domain.high()[a] - domain.low()[a] + 1;
    verts.size[a] = hexes.size[a] + 1;
  }
  complex.num_verts = verts.size[0] * verts.size[1] * verts.size[2];
  LatticeCoord p;
  for (p[2] = 0; p[2] < hexes.size[2]; ++p[2])
    for (p[1] = 0; p[1] < hexes.size[1]; ++p[1])
      for (p[0] = 0; p[0] < hexes.size[0]; ++p[0]) {
        const HexId h = complex.add_hex();
        for (int bits = 0; bits < 8; ++bits)
          complex.verts[h][kHexVertexOfBits[bits]] =
              VertId(verts(p[0] + (bits & 1), p[1] + (bits >> 1 & 1), p[2] + (bits >> 2)));
        LatticeCoord place;
        for (int a = 0; a < 3; ++a) place[a] = (domain.low()[a] + p[a]) * domain.root_edge();
        complex.places[h] = HexPlace::lattice(place);
        for (int lf = 0; lf < 6; ++lf) {
          const int a = lf / 2;
          LatticeCoord next = p;
          next[a] += lf % 2 ? 1 : -1;
          const bool is_boundary = next[a] < 0 || next[a] >= hexes.size[a];
          complex.links[h][lf] = is_boundary
                                     ? FaceLink::to_plane(complex.find_or_add_plane({a, place[a]}))
                                     : FaceLink::to_face(HexId(hexes(next)), opposite_hex_face(lf));
        }
      }
}

}  // namespace hexwright::dual
