#include "dual/positions.h"

namespace hexwright::dual {

namespace {

// Share of the way from the inner to the outer hex at which a cap sits.
constexpr double kCapHeight = 0.4;

Vec3 to_vec3(const LatticeCoord& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// Place of every hex on the finest lattice; caps refer to older hexes only.
IdVector<HexId, Vec3> compute_places(const HexComplex& complex) {
  IdVector<HexId, Vec3> places(complex.num_hexes());
  for (HexId h : complex.verts.ids()) {
    const HexPlace& place = complex.places[h];
    if (place.is_lattice()) {
      places[h] = to_vec3(place.point());
      continue;
    }
    const Vec3 inner = places[place.inner()], outer = places[place.outer()];
    places[h] = inner;
    for (int a = 0; a < 3; ++a)
      if (place.outer_axes() >> a & 1) places[h][a] += kCapHeight * (outer[a] - inner[a]);
  }
  return places;
}

// Calls body(vertex, plane) for every vertex of every boundary face.
template <class Body>
void for_each_boundary_vert(const HexComplex& complex, Body&& body) {
  for (HexId h : complex.verts.ids())
    for (int lf = 0; lf < 6; ++lf)
      if (complex.links[h][lf].is_plane())
        for (int lv : kHexFaces[lf])
          body(complex.verts[h][lv],
               complex.planes[static_cast<std::size_t>(complex.links[h][lf].plane())]);
}

}  // namespace

IdVector<VertId, Vec3> compute_positions(const HexComplex& complex) {
  const auto places = compute_places(complex);
  const auto num_verts = static_cast<std::size_t>(complex.num_verts);
  IdVector<VertId, Vec3> positions(num_verts);
  IdVector<VertId, int> count(num_verts, 0);
  for (HexId h : complex.verts.ids())
    for (VertId v : complex.verts[h]) {
      positions[v] += places[h];
      ++count[v];
    }
  for (VertId v : positions.ids())
    if (count[v] > 0) positions[v] = positions[v] / count[v];
  for_each_boundary_vert(
      complex, [&](VertId v, const DomainPlane& plane) { positions[v][plane.axis] = plane.coord; });
  return positions;
}

IdVector<VertId, std::uint8_t> collect_fixed_axes(const HexComplex& complex) {
  IdVector<VertId, std::uint8_t> fixed(static_cast<std::size_t>(complex.num_verts), 0);
  for_each_boundary_vert(complex, [&](VertId v, const DomainPlane& plane) {
    fixed[v] = static_cast<std::uint8_t>(fixed[v] | 1 << plane.axis);
  });
  return fixed;
}

}  // namespace hexwright::dual
