// Adaptive grids.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"
#include "hexwright/grid/complete.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/evaluate.h"

#include "arrays.h"
#include "binders.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;

constexpr std::int64_t kIndexLimit = std::int64_t{1} << 30;

std::vector<LatticeCoord> to_coords(const AnyArray& array, const std::string& name) {
  const auto flat =
      to_indices(array, 3, {-kIndexLimit, kIndexLimit, "the lattice's coordinates"}, name);
  std::vector<LatticeCoord> coords(flat.size() / 3);
  for (std::size_t i = 0; i < flat.size(); ++i) coords[i / 3][i % 3] = flat[i];
  return coords;
}

/// Where the root cubes stand.
struct Placing {
  std::array<double, 3> origin;
  double size;
};

Grid make(const AnyArray& levels, const AnyArray& indices, const AnyArray& roots,
          const Placing& placing) {
  const auto level = to_indices(levels, 0, {0, kMaxGridLevel + 1, "the levels"}, "levels");
  const auto index = to_coords(indices, "indices");
  if (level.size() != index.size())
    throw Error(
        ErrorCode::BadArgument,
        std::to_string(index.size()) + " rows for " + std::to_string(level.size()) + " levels",
        "indices");
  const auto& o = placing.origin;
  const GridFrame frame{{o[0], o[1], o[2]}, placing.size};
  if (!is_finite(frame.origin) || !(placing.size > 0) || !std::isfinite(placing.size))
    throw Error(ErrorCode::BadArgument, "origin must be finite and size above 0", "size");
  std::vector<CellSpec> cells(level.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = {level[i], index[i]};
  return make_grid(frame, to_coords(roots, "roots"), cells);
}

constexpr std::size_t kStride32 = sizeof(GridCell) / sizeof(std::int32_t);

nb::object corners_of(nb::handle self) {
  const auto& cells = nb::cast<const Grid&>(self).cells.raw();
  const std::int32_t* first = cells.empty() ? nullptr : cells[0].corner.data();
  return view_rows(first, cells.size(), 3, self, kStride32);
}

nb::object levels_of(nb::handle self) {
  const auto& cells = nb::cast<const Grid&>(self).cells.raw();
  const std::int8_t* first = cells.empty() ? nullptr : &cells[0].level;
  return view_values(first, cells.size(), self, sizeof(GridCell));
}

nb::object roots_of(nb::handle self) {
  const auto& roots = nb::cast<const Grid&>(self).roots;
  return view_rows(reinterpret_cast<const std::int32_t*>(roots.data()), roots.size(), 3, self);
}

using Sentence = std::optional<std::string>;

Sentence sentence(const std::optional<Issue>& issue) {
  return issue ? Sentence(issue->message) : std::nullopt;
}

Sentence unbalanced(const Grid& grid, const std::string& balance) {
  if (balance == "relaxed") return sentence(find_unbalanced(grid, Balance::Relaxed));
  if (balance == "weak") return sentence(find_unbalanced(grid, Balance::Weak));
  if (balance == "strong") return sentence(find_unbalanced(grid, Balance::Strong));
  throw Error(ErrorCode::BadArgument, "'" + balance + "' is none of relaxed, weak, strong",
              "balance");
}

void add_questions(nb::class_<Grid>& type) {
  const auto free = nb::call_guard<nb::gil_scoped_release>();
  type.def("find_unbalanced", &unbalanced, "balance"_a, free)
      .def(
          "find_unpaired", [](const Grid& grid) { return sentence(find_unpaired(grid)); }, free)
      .def(
          "find_coarsened",
          [](const Grid& grid, const Grid& before) {
            return sentence(find_coarsened(grid, before));
          },
          "before"_a, free)
      .def(
          "as_hexes", [](const Grid& grid) { return leaves_as_hexes(grid); }, free)
      .def(
          "save", [](const Grid& grid, const std::string& path) { write_grid(path, grid); },
          "path"_a, free);
}

}  // namespace

void bind_grid(nb::module_& module) {
  nb::class_<Grid> type(module, "Grid", "Arrays of an adaptive grid.");
  type.def(
          "__init__",
          [](Grid* self, const AnyArray& levels, const AnyArray& indices, const AnyArray& roots,
             const std::array<double, 3>& origin, double size) {
            new (self) Grid(make(levels, indices, roots, {origin, size}));
          },
          "levels"_a, "indices"_a, "roots"_a, "origin"_a, "size"_a)
      .def_prop_ro("corners", &corners_of,
                   nb::sig("def corners(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro("levels", &levels_of,
                   nb::sig("def levels(self) -> numpy.typing.NDArray[numpy.int8]"))
      .def_prop_ro("roots", &roots_of,
                   nb::sig("def roots(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro("finest_level", [](const Grid& grid) { return grid.finest_level; })
      .def_prop_ro("origin",
                   [](const Grid& grid) {
                     const Vec3& o = grid.frame.origin;
                     return std::array<double, 3>{o.x, o.y, o.z};
                   })
      .def_prop_ro("size", [](const Grid& grid) { return grid.frame.root_size; });
  add_questions(type);
  module.def(
      "read_grid", [](const std::string& path) { return read_grid(path); }, "path"_a,
      nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace hexwright::python
