// Lattice hexes sit at their lattice vertex, caps at a share of the way between the two hexes they
// were made from; a vertex of the mesh is dual to a cell of the arrangement and takes the mean of
// the places of that cell's corners. Regular leaves get their exact centres this way.
#include "dual/complex/positions.h"

#include <algorithm>
#include <map>

#include "hexwright/base/parallel.h"

namespace hexwright::dual {

namespace {

// Share of the way from the inner to the outer hex at which a cap sits.
constexpr double kCapHeight = 0.4;

// At concave corners of the domain several hexes may share one place: it counts once.
Vec3 mean_of_distinct(std::span<const HexCorner> star, const IdVector<HexId, Vec3>& places) {
  Vec3 sum;
  int count = 0;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const Vec3& p = places[star[i].hex];
    bool is_new = true;
    for (std::size_t j = 0; j < i && is_new; ++j) is_new = !(places[star[j].hex] == p);
    if (!is_new) continue;
    sum += p;
    ++count;
  }
  return count ? sum / count : sum;
}

FixedAxes pull_to_planes(const HexComplex& complex, HexMesh& mesh) {
  FixedAxes fixed(mesh.num_verts(), 0);
  for (HexId h : complex.links.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const FaceLink link = complex.links[h][lf];
      if (!link.is_plane()) continue;
      const DomainPlane& plane = complex.planes[static_cast<std::size_t>(link.plane())];
      for (int lv : kHexFaces[lf]) {
        const VertId v = mesh.hexes[h][lv];
        mesh.positions[v][plane.axis] = plane.coord;
        fixed[v] = static_cast<std::uint8_t>(fixed[v] | 1 << plane.axis);
      }
    }
  return fixed;
}

// A step from v towards its star's mean, a quarter of the shortest distance in it.
Vec3 step_inwards(VertId v, std::span<const HexCorner> star, const HexMesh& mesh) {
  Vec3 direction;
  double shortest = std::numeric_limits<double>::infinity();
  for (const HexCorner& c : star)
    for (VertId w : mesh.hexes[c.hex]) {
      const Vec3 offset = mesh.positions[w] - mesh.positions[v];
      direction += offset;
      const double length = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
      if (length > 0) shortest = std::min(shortest, length);
    }
  return 0.25 * shortest * normalized(direction);
}

// Where four octants meet in a chiral path two corner vertices land on one lattice vertex. Both
// leave it, which chamfers the domain there.
void separate_chiral_corners(const Domain& domain, const VertToHex& vert_to_hex, HexMesh& mesh,
                             FixedAxes& fixed) {
  std::map<LatticeCoord, std::vector<VertId>> corners;
  for (VertId v : fixed.ids()) {
    if (fixed[v] != 7) continue;
    LatticeCoord point;
    for (int a = 0; a < 3; ++a) point[a] = static_cast<std::int32_t>(mesh.positions[v][a]);
    if (domain.is_chiral_corner(point)) corners[point].push_back(v);
  }
  std::vector<std::pair<VertId, Vec3>> steps;
  for (const auto& [position, verts] : corners)
    for (VertId v : verts)
      if (verts.size() > 1) steps.push_back({v, step_inwards(v, vert_to_hex[v], mesh)});
  for (const auto& [v, step] : steps) {
    mesh.positions[v] += step;
    fixed[v] = 0;
  }
}

}  // namespace

// Caps refer to older hexes only.
IdVector<HexId, Vec3> compute_places(const HexComplex& complex) {
  IdVector<HexId, Vec3> places(complex.places.size());
  for (HexId h : complex.places.ids()) {
    const HexPlace& place = complex.places[h];
    if (place.is_lattice()) {
      for (int a = 0; a < 3; ++a) places[h][a] = place.point()[a];
      continue;
    }
    const Vec3 inner = places[place.inner()], outer = places[place.outer()];
    places[h] = inner;
    for (int a = 0; a < 3; ++a)
      if (place.outer_axes() >> a & 1) places[h][a] += kCapHeight * (outer[a] - inner[a]);
  }
  return places;
}

FixedAxes place_verts(const Domain& domain, const HexComplex& complex, const VertToHex& vert_to_hex,
                      HexMesh& mesh) {
  const auto places = compute_places(complex);
  parallel_for(mesh.num_verts(), [&](std::size_t v) {
    mesh.positions[VertId(v)] = mean_of_distinct(vert_to_hex[VertId(v)], places);
  });
  FixedAxes fixed = pull_to_planes(complex, mesh);
  if (!domain.is_box()) separate_chiral_corners(domain, vert_to_hex, mesh, fixed);
  return fixed;
}

}  // namespace hexwright::dual
