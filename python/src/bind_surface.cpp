// Surfaces and tet meshes.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/patch_rules.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/surface_io.h"

#include "arrays.h"
#include "binders.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;

/// The group of each face, and the groups' names.
struct Groups {
  std::optional<AnyArray> group;
  std::vector<std::string> names;
};

TriMesh make_surface(const AnyArray& points, const AnyArray& faces, const Groups& groups) {
  TriMesh surface;
  surface.positions = IdVector<VertId, Vec3>(to_points(points, "vertices"));
  surface.tris = IdVector<TriId, std::array<VertId, 3>>(
      to_elements<3>(faces, all_points(surface.num_verts()), "faces"));
  if (groups.group) {
    const auto limit = static_cast<std::int64_t>(groups.names.size());
    surface.group = IdVector<TriId, std::int32_t>(
        to_indices(*groups.group, 0, {-1, limit, "the groups"}, "group"));
    surface.group_names = groups.names;
  }
  if (const auto issue = surface.find_problem())
    throw Error(ErrorCode::BadArgument, issue->message, "surface");
  return surface;
}

TetMesh make_tets(const AnyArray& points, const AnyArray& tets) {
  TetMesh mesh;
  mesh.positions = IdVector<VertId, Vec3>(to_points(points, "points"));
  mesh.tets = IdVector<TetId, std::array<VertId, 4>>(
      to_elements<4>(tets, all_points(mesh.num_verts()), "tets"));
  return mesh;
}

/// The surface with names by rules, and how many triangles each named.
nb::tuple name_by_rules(const TriMesh& surface, const std::vector<std::string>& texts) {
  std::vector<PatchRule> rules;
  for (const std::string& text : texts) {
    rules.push_back(parse_patch_rule(text));
    for (PatchCondition& condition : rules.back().conditions)
      if (!condition.path.empty()) condition.surface = read_surface(condition.path).mesh;
  }
  RuledSurface ruled;
  {
    const nb::gil_scoped_release released;
    ruled = apply_patch_rules(surface, rules);
  }
  return nb::make_tuple(std::move(ruled.surface), ruled.num_matched);
}

/// The surface and what its reader warned of.
nb::tuple read(const std::string& path) {
  SurfaceFile file;
  {
    const nb::gil_scoped_release released;
    file = read_surface(path);
  }
  return nb::make_tuple(std::move(file.mesh), file.warnings);
}

}  // namespace

void bind_surface(nb::module_& module) {
  nb::class_<TriMesh>(module, "Surface", "A triangle surface.")
      .def(
          "__init__",
          [](TriMesh* self, const AnyArray& points, const AnyArray& faces,
             const std::optional<AnyArray>& group, const std::vector<std::string>& names) {
            new (self) TriMesh(make_surface(points, faces, {group, names}));
          },
          "vertices"_a, "faces"_a, "group"_a.none() = nb::none(), "group_names"_a = nb::list())
      .def_prop_ro(
          "vertices",
          [](nb::handle self) {
            return view_points(nb::cast<const TriMesh&>(self).positions.raw(), self);
          },
          nb::sig("def vertices(self) -> numpy.typing.NDArray[numpy.float64]"))
      .def_prop_ro(
          "faces",
          [](nb::handle self) {
            return view_elements(nb::cast<const TriMesh&>(self).tris.raw(), self);
          },
          nb::sig("def faces(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro(
          "group",
          [](nb::handle self) {
            const auto& group = nb::cast<const TriMesh&>(self).group.raw();
            return view_values(group.data(), group.size(), self);
          },
          nb::sig("def group(self) -> numpy.typing.NDArray[numpy.int32]"))
      .def_prop_ro("group_names", [](const TriMesh& surface) { return surface.group_names; });
  nb::class_<TetMesh>(module, "TetMesh", "A tetrahedral mesh.")
      .def(
          "__init__",
          [](TetMesh* self, const AnyArray& points, const AnyArray& tets) {
            new (self) TetMesh(make_tets(points, tets));
          },
          "points"_a, "tets"_a)
      .def_prop_ro(
          "points",
          [](nb::handle self) {
            return view_points(nb::cast<const TetMesh&>(self).positions.raw(), self);
          },
          nb::sig("def points(self) -> numpy.typing.NDArray[numpy.float64]"));
  module.def("name_by_rules", &name_by_rules, "surface"_a, "rules"_a);
  module.def("read_surface", &read, "path"_a);
  module.def(
      "write_surface",
      [](const std::string& path, const TriMesh& surface) { write_surface(path, surface); },
      "path"_a, "surface"_a, nb::call_guard<nb::gil_scoped_release>());
  module.def(
      "read_tets", [](const std::string& path) { return read_tet_mesh(path); }, "path"_a,
      nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace hexwright::python
