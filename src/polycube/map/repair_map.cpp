// Untangles a map in two steps: edges that join two vertices of one face through the inside are
// split, because their tets are flat whatever is done to the vertices; then the vertices around
// non-positive tets are moved by minimising an energy that is infinite for folded tets.
//
// Based on: Garanzha et al., "Foldover-free maps in 50 lines of code", ACM TOG 40(4), 2021, for the
// energy (unfold.h).
// Differs: only the surroundings of folds move, ring by ring, so that a good map stays what its
// author made it.
#include "polycube/map/repair_map.h"

#include <algorithm>
#include <set>

#include "polycube/tets/tet_locator.h"
#include "polycube/tets/unfold.h"

namespace hexwright::polycube {
namespace {

// Surroundings tried, in rings of tets around those that are not positive; -1 = everything.
constexpr int kRings[] = {2, 5, -1};

using Edge = std::array<VertId, 2>;

Edge make_edge(VertId a, VertId b) { return {std::min(a, b), std::max(a, b)}; }

// The charts that each boundary vertex lies on, ascending.
std::vector<std::vector<int>> charts_of_verts(const Lattice& lattice) {
  std::vector<std::vector<int>> charts(lattice.tets.num_verts());
  for (TriId f : lattice.facets.ids())
    for (VertId v : lattice.facets[f]) charts[v.index()].push_back(lattice.facet_to_chart[f]);
  for (auto& list : charts) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return charts;
}

bool share_chart(const std::vector<int>& a, const std::vector<int>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int chart) { return std::binary_search(b.begin(), b.end(), chart); });
}

// Edges of the tets that are no facet's edge and run from a chart to the same chart.
std::set<Edge> find_chords(const Lattice& lattice) {
  const auto charts = charts_of_verts(lattice);
  std::set<Edge> on_boundary, chords;
  for (const auto& f : lattice.facets)
    for (std::size_t k = 0; k < 3; ++k) on_boundary.insert(make_edge(f[k], f[(k + 1) % 3]));
  for (const auto& tet : lattice.tets.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Edge edge = make_edge(tet[i], tet[j]);
        if (share_chart(charts[edge[0].index()], charts[edge[1].index()]) &&
            !on_boundary.contains(edge))
          chords.insert(edge);
      }
  return chords;
}

// Splits edges at their middle in both meshes. All tets around an edge are cut in two.
class EdgeSplitter {
 public:
  EdgeSplitter(TetMesh& object, TetMesh& polycube, IdVector<TetId, TetId>& to_input)
      : object_(object), polycube_(polycube), to_input_(to_input), tets_of_(object.num_verts()) {
    for (TetId t : object.tets.ids())
      for (VertId v : object.tets[t]) tets_of_[v.index()].push_back(t);
  }

  // Each tet around the edge becomes two: one keeps its number and gets the middle in place of the
  // edge's first end, the other is appended. Both keep the orientation.
  void split(const Edge& edge) {
    const VertId middle = add_middle(object_, edge);
    add_middle(polycube_, edge);
    tets_of_.emplace_back();
    const auto around = tets_of_[edge[0].index()];  // some have left the vertex since
    for (TetId t : around) {
      auto& tet = object_.tets[t];
      const auto a = std::find(tet.begin(), tet.end(), edge[0]);
      if (a == tet.end() || std::find(tet.begin(), tet.end(), edge[1]) == tet.end()) continue;
      auto other = tet;
      *a = middle;
      *std::find(other.begin(), other.end(), edge[1]) = middle;
      add(t, other);
    }
  }

 private:
  static VertId add_middle(TetMesh& mesh, const Edge& edge) {
    return mesh.positions.push_back((mesh.positions[edge[0]] + mesh.positions[edge[1]]) * 0.5);
  }

  // `t` has just lost an end of the edge to the middle; `other` is its other half.
  void add(TetId t, const std::array<VertId, 4>& other) {
    polycube_.tets[t] = object_.tets[t];
    for (VertId v : object_.tets[t])
      if (v.index() + 1 == tets_of_.size()) tets_of_[v.index()].push_back(t);
    const TetId added = object_.tets.push_back(other);
    polycube_.tets.push_back(other);
    to_input_.push_back(to_input_[t]);
    for (VertId v : other) tets_of_[v.index()].push_back(added);
  }

  TetMesh &object_, &polycube_;
  IdVector<TetId, TetId>& to_input_;
  std::vector<std::vector<TetId>> tets_of_;
};

// The axes along which a vertex may move without leaving its faces of the polycube.
IdVector<VertId, std::uint8_t> find_free_axes(const Lattice& lattice) {
  IdVector<VertId, std::uint8_t> free(lattice.tets.num_verts(), 7);
  for (TriId f : lattice.facets.ids()) {
    const Chart& chart = lattice.charts[static_cast<std::size_t>(lattice.facet_to_chart[f])];
    for (VertId v : lattice.facets[f])
      free[v] = static_cast<std::uint8_t>(free[v] & ~(1 << chart.axis));
  }
  return free;
}

// Fixes all vertices farther than `rings` rings of tets from the non-positive ones.
void fix_beyond(const TetMesh& polycube, int rings, IdVector<VertId, std::uint8_t>& free_axes) {
  if (rings < 0) return;
  IdVector<VertId, char> is_near(polycube.num_verts(), 0);
  for (TetId t : polycube.tets.ids())
    if (is_nonpositive(polycube, t))
      for (VertId v : polycube.tets[t]) is_near[v] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    const auto last = is_near;
    for (const auto& tet : polycube.tets)
      if (std::any_of(tet.begin(), tet.end(), [&](VertId v) { return last[v] != 0; }))
        for (VertId v : tet) is_near[v] = 1;
  }
  for (VertId v : is_near.ids())
    if (!is_near[v]) free_axes[v] = 0;
}

}  // namespace

RepairReport repair_map(TetMesh& object, Lattice& lattice, const Context& context) {
  RepairReport report;
  for (TetId t : object.tets.ids()) report.to_input.push_back(t);
  const std::size_t before = report.num_nonpositive = count_nonpositive(lattice.tets);
  if (before == 0) return report;
  const TetMesh old_object = object, old_polycube = lattice.tets;
  const auto old_to_input = report.to_input;

  const auto chords = find_chords(lattice);
  report.num_split_edges = chords.size();
  EdgeSplitter splitter(object, lattice.tets, report.to_input);
  for (const Edge& edge : chords) splitter.split(edge);
  for (int rings : kRings) {
    TetMesh trial = lattice.tets;
    auto free_axes = find_free_axes(lattice);
    fix_beyond(trial, rings, free_axes);
    unfold(object, free_axes, trial, context);
    report.num_nonpositive = count_nonpositive(trial);
    if (report.num_nonpositive > 0 && rings >= 0) continue;
    lattice.tets = std::move(trial);
    break;
  }
  if (report.num_nonpositive < before) return report;
  // Nothing was gained: the splits alone would only make the mesh larger.
  object = old_object;
  lattice.tets = old_polycube;
  return {0, before, old_to_input};
}

}  // namespace hexwright::polycube
