// Tries base levels from coarse to fine and keeps the cheapest completed grid.
#include "hexwright/grid/even_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

namespace hexwright {
namespace {

enum class Place : char { Outside, Inside, AtSurface };

using Places = IdVector<CellId, Place>;

/// A grid and where its leaves lie.
struct PlacedGrid {
  Grid grid;
  Places places;
};

Place find_place(const SurfaceTree& tree, const Box3& box) {
  const Vec3 center = box.center();
  ClosestFilter filter;
  filter.max_distance = 0.5 * box.diagonal();
  if (tree.closest(center, filter)) return Place::AtSurface;
  return tree.is_inside(center) ? Place::Inside : Place::Outside;
}

/// Leaves inherit their place from the leaf of the coarser grid that holds them, unless that one is
/// at the surface.
Places find_places(const Grid& grid, const PlacedGrid* coarser, const SurfaceTree& tree) {
  Places places(grid.num_cells(), Place::AtSurface);
  parallel_for(
      grid.num_cells(),
      [&](std::size_t i) {
        const Box3 box = cell_box(grid, CellId(i));
        Place place = Place::AtSurface;
        if (coarser) place = coarser->places[find_leaf_at(coarser->grid, box.center())];
        places[CellId(i)] = place == Place::AtSurface ? find_place(tree, box) : place;
      },
      64);
  return places;
}

/// Whether a face neighbour has another level: one neighbour of the same level fills a whole face.
bool is_at_transition(const Grid& grid, CellId c) {
  const Box3 box = cell_box(grid, c);
  const Vec3 center = box.center(), step = box.extent() * 0.51;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 beyond = center;
      beyond[axis] += side * step[axis];
      const CellId other = find_leaf_at(grid, beyond);
      if (other.is_valid() && grid.cells[other].level != grid.cells[c].level) return true;
    }
  return false;
}

struct Cost {
  std::size_t num_leaves = 0, num_at_transitions = 0;
  double weighted(double transition_cost) const {
    return static_cast<double>(num_leaves) +
           transition_cost * static_cast<double>(num_at_transitions);
  }
};

/// Of the leaves that are not outside.
Cost measure_cost(const Grid& grid, const Places& places) {
  const auto count = [&](std::size_t begin, std::size_t end) {
    Cost cost;
    for (std::size_t i = begin; i < end; ++i) {
      if (places[CellId(i)] == Place::Outside) continue;
      ++cost.num_leaves;
      cost.num_at_transitions += is_at_transition(grid, CellId(i));
    }
    return cost;
  };
  const auto add = [](Cost a, const Cost& b) {
    return Cost{a.num_leaves + b.num_leaves, a.num_at_transitions + b.num_at_transitions};
  };
  return parallel_reduce(grid.num_cells(), Cost{}, count, add, 1024);
}

/// The object's leaves above the base level are split once.
PlacedGrid deepen(const PlacedGrid& from, int base_level, const SurfaceTree& tree) {
  std::vector<char> marks(from.grid.num_cells(), 0);
  for (CellId c : from.grid.cells.ids())
    marks[c.index()] = from.places[c] != Place::Outside && from.grid.cells[c].level < base_level;
  PlacedGrid result;
  result.grid = split_cells(from.grid, marks);
  result.places = find_places(result.grid, &from, tree);
  return result;
}

std::size_t count_object_leaves(const PlacedGrid& placed) {
  return placed.grid.num_cells() -
         static_cast<std::size_t>(
             std::count(placed.places.raw().begin(), placed.places.raw().end(), Place::Outside));
}

EvenedGrid complete_and_price(const PlacedGrid& placed, const SurfaceTree& tree,
                              const CompleteOptions& options, double transition_cost,
                              const Context& context) {
  EvenedGrid result;
  result.completed = complete(placed.grid, options, context);
  const Grid& grid = result.completed.grid;
  result.cost = measure_cost(grid, find_places(grid, &placed, tree)).weighted(transition_cost);
  return result;
}

}  // namespace

EvenedGrid even_levels(const Grid& grid, const SurfaceTree& tree, const CompleteOptions& complete,
                       const EvenOptions& options, const Context& context) {
  PlacedGrid current{grid, find_places(grid, nullptr, tree)};
  EvenedGrid best = complete_and_price(current, tree, complete, options.transition_cost, context);
  if (options.transition_cost <= 0) return best;
  for (int base_level = 1; base_level <= grid.finest_level; ++base_level) {
    context.check_cancelled();
    const std::size_t num_before = current.grid.num_cells();
    current = deepen(current, base_level, tree);
    if (current.grid.num_cells() == num_before) continue;
    if (static_cast<double>(count_object_leaves(current)) >= best.cost) break;
    EvenedGrid evened =
        complete_and_price(current, tree, complete, options.transition_cost, context);
    evened.base_level = base_level;
    if (evened.completed.grid.num_cells() > options.max_cells) break;
    if (evened.cost < best.cost) best = std::move(evened);
  }
  return best;
}

}  // namespace hexwright
