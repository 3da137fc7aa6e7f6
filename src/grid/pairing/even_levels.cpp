// Tries base levels from coarse to fine and keeps the cheapest completed grid.
#include "hexwright/grid/even_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

#include "base/disjoint_sets.h"

namespace hexwright {
namespace {

enum class Place : char { Outside, Inside, AtSurface };

using Places = IdVector<CellId, Place>;

/// A grid and where its leaves lie.
struct PlacedGrid {
  Grid grid;
  Places places;
};

/// Where the leaves of grids around one object lie.
class PlaceFinder {
 public:
  explicit PlaceFinder(const Occupancy& object) : object_(object) {}

  /// Leaves inherit their place from the leaf of the coarser grid that holds them, unless that one
  /// is at the surface.
  Places find(const Grid& grid, const PlacedGrid* coarser) const {
    Places places(grid.num_cells(), Place::AtSurface);
    IdVector<CellId, char> is_open(grid.num_cells(), 0);  // off the surface, side unknown
    parallel_for(
        grid.num_cells(),
        [&](std::size_t i) {
          const CellId c(i);
          const Box3 box = cell_box(grid, c);
          if (coarser) places[c] = coarser->places[find_leaf_at(coarser->grid, box.center())];
          if (places[c] != Place::AtSurface || object_.meets_surface(box)) return;
          if (object_.has_two_sides)
            is_open[c] = 1;
          else
            places[c] = side_of(box);
        },
        64);
    if (object_.has_two_sides) settle_pieces(grid, is_open, places);
    return places;
  }

 private:
  using Faces = std::array<CellId, 6>;

  Place side_of(const Box3& box) const {
    return object_.is_inside(box.center()) ? Place::Inside : Place::Outside;
  }

  /// Leaves off the surface that share a face lie on the same side of a closed surface: one winding
  /// number, slow where needles crowd, serves a whole piece of them, or none where a neighbour's
  /// place is known.
  void settle_pieces(const Grid& grid, const IdVector<CellId, char>& is_open,
                     Places& places) const {
    std::vector<CellId> open;
    for (CellId c : is_open.ids())
      if (is_open[c]) open.push_back(c);
    std::vector<Faces> faces(open.size());
    parallel_for(
        open.size(), [&](std::size_t i) { faces[i] = neighbors_across(grid, open[i]); }, 256);
    BasicDisjointSets<std::int32_t> pieces(grid.num_cells());
    for (std::size_t i = 0; i < open.size(); ++i)
      for (CellId other : faces[i])
        if (other.is_valid() && is_open[other]) pieces.unite(open[i].value(), other.value());
    Places of_piece(grid.num_cells(), Place::AtSurface);  // by the piece's representative
    for (std::size_t i = 0; i < open.size(); ++i)
      for (CellId other : faces[i])
        if (other.is_valid() && !is_open[other] && places[other] != Place::AtSurface)
          of_piece[CellId(pieces.find(open[i].value()))] = places[other];
    for (CellId c : open) {
      Place& place = of_piece[CellId(pieces.find(c.value()))];
      if (place == Place::AtSurface) place = side_of(cell_box(grid, c));
      places[c] = place;
    }
  }

  /// The leaves that hold the points just beyond the middles of the faces; invalid outside the
  /// grid. Of smaller neighbours this finds one: they find this leaf themselves.
  static Faces neighbors_across(const Grid& grid, CellId c) {
    const Box3 box = cell_box(grid, c);
    Faces found;
    for (std::size_t face = 0; face < 6; ++face) {
      const int axis = static_cast<int>(face / 2);
      Vec3 beyond = box.center();
      beyond[axis] += (face % 2 == 0 ? -0.51 : 0.51) * box.extent()[axis];
      found[face] = find_leaf_at(grid, beyond);
    }
    return found;
  }

  const Occupancy& object_;
};

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
PlacedGrid deepen(const PlacedGrid& from, int base_level, const PlaceFinder& finder) {
  std::vector<char> marks(from.grid.num_cells(), 0);
  for (CellId c : from.grid.cells.ids())
    marks[c.index()] = from.places[c] != Place::Outside && from.grid.cells[c].level < base_level;
  PlacedGrid result;
  result.grid = split_cells(from.grid, marks);
  result.places = finder.find(result.grid, &from);
  return result;
}

std::size_t count_object_leaves(const PlacedGrid& placed) {
  return placed.grid.num_cells() -
         static_cast<std::size_t>(
             std::count(placed.places.raw().begin(), placed.places.raw().end(), Place::Outside));
}

EvenedGrid complete_and_price(const PlacedGrid& placed, const PlaceFinder& finder,
                              const CompleteOptions& options, double transition_cost,
                              const Context& context) {
  EvenedGrid result;
  result.completed = complete(placed.grid, options, context);
  const Grid& grid = result.completed.grid;
  result.cost = measure_cost(grid, finder.find(grid, &placed)).weighted(transition_cost);
  return result;
}

}  // namespace

EvenedGrid even_levels(const Grid& grid, const Occupancy& object, const CompleteOptions& complete,
                       const EvenOptions& options, const Context& context) {
  const auto watch = context.watch();
  const PlaceFinder finder(object);
  PlacedGrid current{grid, finder.find(grid, nullptr)};
  EvenedGrid best = complete_and_price(current, finder, complete, options.transition_cost, context);
  if (options.transition_cost <= 0) return best;
  for (int base_level = 1; base_level <= grid.finest_level; ++base_level) {
    context.check_cancelled();
    const std::size_t num_before = current.grid.num_cells();
    current = deepen(current, base_level, finder);
    if (current.grid.num_cells() == num_before) continue;
    const std::size_t num_in_object = count_object_leaves(current);
    if (num_in_object > options.max_object_cells) break;
    if (static_cast<double>(num_in_object) >= best.cost) break;
    EvenedGrid evened =
        complete_and_price(current, finder, complete, options.transition_cost, context);
    evened.base_level = base_level;
    if (evened.completed.grid.num_cells() > options.max_cells) break;
    if (evened.cost < best.cost) best = std::move(evened);
  }
  return best;
}

}  // namespace hexwright
