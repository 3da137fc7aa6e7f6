// Gives away the smallest chart first, to the neighbour in whose plane it nearly lies, until all
// are large enough for the lattice; then joins charts that have become neighbours on one plane.
#include "polycube/lattice/merge_charts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hexwright::polycube {
namespace {

// In lattice squares: a chart smaller than this has no quad of the coarsest mesh to itself.
constexpr double kLeastSquares = 0.25;
constexpr double kCoplanar = 0.1;  // share of the spacing

// In the input's units, before the lattice is known.
std::vector<double> chart_areas(const Lattice& lattice) {
  std::vector<double> area(lattice.charts.size(), 0);
  const auto& p = lattice.tets.positions;
  for (TriId t : lattice.facets.ids()) {
    const auto& f = lattice.facets[t];
    area[static_cast<std::size_t>(lattice.facet_to_chart[t])] +=
        norm(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]])) / 2;
  }
  return area;
}

// The neighbouring chart whose plane the facets of `chart` stray least from, -1 when it has no
// neighbour; the lowest among equals.
int nearest_neighbor(const Lattice& lattice, int chart,
                     const IdVector<TriId, std::array<TriId, 3>>& neighbor) {
  std::set<int> candidates;
  for (TriId t : lattice.facets.ids()) {
    if (lattice.facet_to_chart[t] != chart) continue;
    for (TriId other : neighbor[t])
      if (other.is_valid() && lattice.facet_to_chart[other] != chart)
        candidates.insert(lattice.facet_to_chart[other]);
  }
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int candidate : candidates) {
    const Chart& plane = lattice.charts[static_cast<std::size_t>(candidate)];
    double farthest = 0;
    for (TriId t : lattice.facets.ids())
      if (lattice.facet_to_chart[t] == chart)
        for (VertId v : lattice.facets[t])
          farthest = std::max(farthest,
                              std::abs(lattice.tets.positions[v][plane.axis] - plane.coordinate));
    if (farthest >= least) continue;
    least = farthest;
    best = candidate;
  }
  return best;
}

// Charts of one direction that have become neighbours on nearly one plane are one.
void join_coplanar(Lattice& lattice, const IdVector<TriId, std::array<TriId, 3>>& neighbor,
                   double spacing) {
  const auto are_coplanar = [&](int a, int b) {
    const Chart &x = lattice.charts[static_cast<std::size_t>(a)],
                &y = lattice.charts[static_cast<std::size_t>(b)];
    return x.axis == y.axis && x.sign == y.sign &&
           std::abs(x.coordinate - y.coordinate) < kCoplanar * spacing;
  };
  for (TriId t : lattice.facets.ids())
    for (TriId other : neighbor[t]) {
      if (!other.is_valid()) continue;
      const int a = lattice.facet_to_chart[t], b = lattice.facet_to_chart[other];
      if (a == b || !are_coplanar(a, b)) continue;
      for (int& chart : lattice.facet_to_chart)
        if (chart == std::max(a, b)) chart = std::min(a, b);
    }
}

// Numbers the charts that still have facets, in their old order.
void drop_empty_charts(Lattice& lattice) {
  std::vector<int> old_to_new(lattice.charts.size(), -1);
  for (int chart : lattice.facet_to_chart) old_to_new[static_cast<std::size_t>(chart)] = 0;
  std::vector<Chart> kept;
  for (std::size_t c = 0; c < old_to_new.size(); ++c) {
    if (old_to_new[c] < 0) continue;
    old_to_new[c] = static_cast<int>(kept.size());
    kept.push_back(lattice.charts[c]);
  }
  for (int& chart : lattice.facet_to_chart) chart = old_to_new[static_cast<std::size_t>(chart)];
  lattice.charts = std::move(kept);
}

}  // namespace

std::size_t merge_small_charts(Lattice& lattice,
                               const IdVector<TriId, std::array<TriId, 3>>& neighbor,
                               double spacing) {
  auto area = chart_areas(lattice);
  std::size_t num_merged = 0;
  for (;;) {
    // The smallest first: what it is given to may grow large enough to stay.
    int smallest = -1;
    for (std::size_t c = 0; c < area.size(); ++c)
      if (area[c] < kLeastSquares * spacing * spacing &&
          (smallest < 0 || area[c] < area[static_cast<std::size_t>(smallest)]))
        smallest = static_cast<int>(c);
    if (smallest < 0) break;
    double& lost = area[static_cast<std::size_t>(smallest)];
    const int heir = nearest_neighbor(lattice, smallest, neighbor);
    if (heir >= 0) {
      area[static_cast<std::size_t>(heir)] += lost;
      for (int& chart : lattice.facet_to_chart)
        if (chart == smallest) chart = heir;
      ++num_merged;
    }
    // Also without an heir (a whole component of the boundary may be one small chart): the loop
    // must come to an end.
    lost = std::numeric_limits<double>::infinity();  // done with
  }
  if (num_merged > 0) join_coplanar(lattice, neighbor, spacing);
  drop_empty_charts(lattice);
  return num_merged;
}

}  // namespace hexwright::polycube
