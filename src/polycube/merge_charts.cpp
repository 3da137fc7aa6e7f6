#include "polycube/merge_charts.h"

#include <algorithm>
#include <map>

namespace hexwright::polycube {
namespace {

constexpr double kLeastSquares = 0.25;

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

// The chart across most edges of `chart`, -1 when it has no neighbour; the lowest among equals.
int longest_neighbor(const Lattice& lattice, int chart,
                     const IdVector<TriId, std::array<TriId, 3>>& neighbor) {
  std::map<int, int> num_edges;
  for (TriId t : lattice.facets.ids()) {
    if (lattice.facet_to_chart[t] != chart) continue;
    for (TriId other : neighbor[t])
      if (other.is_valid() && lattice.facet_to_chart[other] != chart)
        ++num_edges[lattice.facet_to_chart[other]];
  }
  int best = -1;
  for (const auto& [other, count] : num_edges)
    if (best < 0 || count > num_edges[best]) best = other;
  return best;
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
    const int heir = longest_neighbor(lattice, smallest, neighbor);
    if (heir >= 0) {
      area[static_cast<std::size_t>(heir)] += lost;
      for (int& chart : lattice.facet_to_chart)
        if (chart == smallest) chart = heir;
      ++num_merged;
    }
    lost = std::numeric_limits<double>::infinity();  // done with
  }
  drop_empty_charts(lattice);
  return num_merged;
}

}  // namespace hexwright::polycube
