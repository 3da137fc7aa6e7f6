// Hex meshes: views of their arrays, their labelled parts, quality and files.
#include <algorithm>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/io/atomic_file.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/set_table.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/render/picture.h"
#include "hexwright/render/view_page.h"

#include "arrays.h"
#include "binders.h"
#include "facets.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;

HexMesh make_mesh(const AnyArray& points, const AnyArray& hexes,
                  const std::optional<AnyArray>& regions) {
  HexMesh mesh;
  mesh.positions = IdVector<VertId, Vec3>(to_points(points, "points"));
  mesh.hexes = IdVector<HexId, std::array<VertId, 8>>(
      to_elements<8>(hexes, all_points(mesh.num_verts()), "hexes"));
  if (regions) {
    mesh.region = IdVector<HexId, std::int32_t>(
        to_indices(*regions, 0, {INT32_MIN, INT32_MAX, "the 32-bit tags"}, "regions"));
    if (mesh.region.size() != mesh.num_hexes())
      throw Error(ErrorCode::BadArgument,
                  std::to_string(mesh.region.size()) + " tags for " +
                      std::to_string(mesh.num_hexes()) + " hexes",
                  "regions");
  }
  return mesh;
}

const HexMesh& mesh_of(nb::handle self) { return nb::cast<const HexMesh&>(self); }

nb::object points_of(nb::handle self) { return view_points(mesh_of(self).positions.raw(), self); }

nb::object hexes_of(nb::handle self) { return view_elements(mesh_of(self).hexes.raw(), self); }

/// A mesh without tags has the tag 0 everywhere: one number, seen as often as there are hexes.
nb::object regions_of(nb::handle self) {
  static const std::int32_t kZero = 0;
  const HexMesh& mesh = mesh_of(self);
  if (mesh.region.empty()) return view_values(&kZero, mesh.num_hexes(), self, 0);
  return view_values(mesh.region.raw().data(), mesh.num_hexes(), self);
}

/// Points and mid-nodes as one array, and the 20 nodes of each hex in VTK's order.
nb::tuple second_order_of(const HexMesh& mesh) {
  std::vector<Vec3> points;
  std::vector<std::array<VertId, 20>> hexes;
  {
    const nb::gil_scoped_release released;
    const MidNodes nodes = mesh.mid_nodes ? *mesh.mid_nodes : make_straight_mid_nodes(mesh);
    points = mesh.positions.raw();
    points.insert(points.end(), nodes.edges.begin(), nodes.edges.end());
    hexes.resize(mesh.num_hexes());
    for (HexId h : mesh.hexes.ids()) {
      std::copy(mesh.hexes[h].begin(), mesh.hexes[h].end(), hexes[h.index()].begin());
      for (std::size_t le = 0; le < 12; ++le)
        hexes[h.index()][8 + le] = VertId(mesh.num_verts() + nodes.hex_to_edge[h][le].index());
    }
  }
  const auto [held_points, points_owner] = keep(std::move(points));
  const auto [held_hexes, hexes_owner] = keep(std::move(hexes));
  return nb::make_tuple(view_points(*held_points, points_owner),
                        view_elements(*held_hexes, hexes_owner));
}

nb::object corners_of(nb::handle self) { return view_ids(mesh_of(self).labels.corners, self); }

std::vector<double> measure(const HexMesh& mesh, const std::string& name) {
  if (name == "scaled_jacobian") return compute_scaled_jacobians(mesh).raw();
  std::vector<double> values(mesh.num_hexes());
  if (name == "volume")
    parallel_for(values.size(),
                 [&](std::size_t i) { values[i] = hex_volume(mesh.corners(HexId(i))); });
  else if (name == "positivity")
    parallel_for(values.size(), [&](std::size_t i) {
      const Positivity p = check_positivity(mesh.corners(HexId(i)));
      values[i] = p == Positivity::Positive ? 1 : p == Positivity::NotPositive ? -1 : 0;
    });
  else
    throw Error(ErrorCode::BadArgument,
                "'" + name + "' is none of scaled_jacobian, volume, positivity", "quality");
  return values;
}

nb::object quality_of(const HexMesh& mesh, const std::string& name) {
  std::vector<double> values;
  {
    const nb::gil_scoped_release released;
    values = measure(mesh, name);
  }
  return give_values(std::move(values));
}

using Field = std::pair<std::string, AnyArray>;

/// Names of sets that the format could not take, each with what was written instead.
std::vector<std::pair<std::string, std::string>> save(const HexMesh& mesh, const std::string& path,
                                                      const std::vector<Field>& fields,
                                                      const std::string& format,
                                                      int nodes_per_hex) {
  WriteHexOptions options;
  options.format = format;
  options.nodes_per_hex = nodes_per_hex;
  for (const auto& [name, values] : fields)
    options.fields.push_back({name, to_numbers(values, mesh.num_hexes(), name)});
  const nb::gil_scoped_release released;
  // Last, as the command line has it.
  options.fields.push_back({"scaled_jacobian", compute_scaled_jacobians(mesh).raw()});
  std::vector<std::pair<std::string, std::string>> changed;
  for (const ChangedName& name : write_hex_mesh(path, mesh, options).changed_names)
    changed.emplace_back(name.given, name.written);
  return changed;
}

std::vector<std::string> first_names(const HexMesh& mesh, SetKind kind, std::size_t count) {
  std::vector<std::string> names(count);
  for (std::size_t k = 0; k < count; ++k)
    names[k] = set_name(mesh, kind, static_cast<std::int32_t>(k));
  return names;
}

void write_view(const std::string& path, const HexMesh& mesh, const std::string& title,
                const TriMesh* surface, const std::vector<Field>& fields) {
  ViewOptions options;
  options.title = title;
  for (const auto& [name, values] : fields)
    options.fields.push_back({name, to_numbers(values, mesh.num_hexes(), name)});
  const nb::gil_scoped_release released;
  std::optional<SurfaceTree> tree;
  if (surface) options.surface = &tree.emplace(*surface);
  write_file_atomically(path, make_view_page(mesh, options));
}

nb::tuple facets_of(nb::handle self) {
  FacetTable table;
  {
    const HexMesh& mesh = mesh_of(self);
    const nb::gil_scoped_release released;
    table = sort_facets(mesh);
  }
  const auto [held, owner] = keep(std::move(table));
  return nb::make_tuple(view_elements(held->quads.verts, owner), view_ids(held->owner, owner),
                        view_values(held->side.data(), held->side.size(), owner), held->quads.start,
                        first_names(mesh_of(self), SetKind::Patch, held->quads.start.size() - 1));
}

nb::tuple curves_of(nb::handle self) {
  const auto [held, owner] = keep(sort_curves(mesh_of(self)));
  return nb::make_tuple(view_elements(held->verts, owner), held->start,
                        first_names(mesh_of(self), SetKind::Curve, held->start.size() - 1));
}

/// The same views as `hexwright picture`.
PictureOptions make_view(const HexMesh& mesh, const std::string& cut, std::optional<double> at) {
  if (cut != "auto" && cut != "none") {
    const int axis = cut[0] - 'x';
    return make_cut_view(axis, at ? *at : find_clear_cut(mesh, axis));
  }
  PictureOptions view = make_default_view(mesh);
  if (cut == "none")
    view.cut.reset();
  else if (at)
    view.cut->offset = *at;
  return view;
}

nb::object draw(const HexMesh& mesh, const std::string& cut, std::optional<double> at, int width,
                int height) {
  Image image;
  {
    const nb::gil_scoped_release released;
    PictureOptions view = make_view(mesh, cut, at);
    view.width = width;
    view.height = height;
    image = render_hex_mesh(mesh, view);
  }
  return give_values(std::move(image.rgb));
}

void add_views(nb::class_<HexMesh>& type) {
  type.def_prop_ro("points", &points_of,
                   nb::sig("def points(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro("hexes", &hexes_of,
                   nb::sig("def hexes(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro("regions", &regions_of,
                   nb::sig("def regions(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro("corners", &corners_of,
                   nb::sig("def corners(self) -> numpy.typing.NDArray[numpy.int32]"));
}

}  // namespace

void bind_mesh(nb::module_& module) {
  nb::class_<HexMesh> type(module, "HexMesh", "Arrays of a hex mesh.");
  type.def(
      "__init__",
      [](HexMesh* self, const AnyArray& points, const AnyArray& hexes,
         const std::optional<AnyArray>& regions) {
        new (self) HexMesh(make_mesh(points, hexes, regions));
      },
      "points"_a, "hexes"_a, "regions"_a.none() = nb::none());
  add_views(type);
  type.def_prop_ro("region_names", [](const HexMesh& mesh) { return mesh.region_names; });
  type.def(
      "region_name",
      [](const HexMesh& mesh, std::int32_t tag) { return set_name(mesh, SetKind::Region, tag); },
      "tag"_a);
  type.def("quality", &quality_of, "name"_a,
           nb::sig("def quality(self, name: str) -> numpy.typing.NDArray[numpy.float64]"))
      .def("save", &save, "path"_a, "fields"_a, "format"_a, "nodes"_a)
      .def_prop_ro("order", [](const HexMesh& mesh) { return mesh.mid_nodes ? 2 : 1; })
      .def("second_order", &second_order_of)
      .def("facets", &facets_of)
      .def("curves", &curves_of);
  module.def("write_view", &write_view, "path"_a, "mesh"_a, "title"_a, "surface"_a.none(),
             "fields"_a);
  module.def(
      "image", &draw, "mesh"_a, "cut"_a, "at"_a.none(), "width"_a, "height"_a,
      nb::sig("def image(mesh: HexMesh, cut: str, at: float | None, width: int, height: int) -> "
              "numpy.typing.NDArray[numpy.uint8]"));
  module.def(
      "read_mesh", [](const std::string& path) { return read_hex_mesh(path); }, "path"_a,
      nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace hexwright::python
