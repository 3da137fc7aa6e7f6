#include "size_field.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/surface_tree.h"

namespace hexwright::python {
namespace {

using Sizes = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

constexpr const char* kName = "sizes";

SizeRule field_rule(PointField field) {
  SizeRule rule;
  rule.where = SizeRule::Where::Field;
  rule.text = kName;
  rule.field = std::make_shared<const PointField>(std::move(field));
  return rule;
}

/// Between the values at the corners, by areas; the least where the triangle has none.
double interpolate(const TriMesh& surface, const ClosestPoint& at,
                   const std::vector<double>& values) {
  const auto c = surface.corners(at.tri);
  const auto value = [&](std::size_t k) { return values[surface.tris[at.tri][k].index()]; };
  const auto [least, most] = std::minmax({value(0), value(1), value(2)});
  const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
  const double area = norm_sq(normal);
  if (!(area > 0)) return least;
  const double a = dot(cross(c[1] - at.point, c[2] - at.point), normal) / area;
  const double b = dot(cross(c[2] - at.point, c[0] - at.point), normal) / area;
  const double size = a * value(0) + b * value(1) + (1 - a - b) * value(2);
  return size >= least ? std::min(size, most) : least;  // slivers round
}

std::vector<Vec3> centroids(const TriMesh& surface) {
  std::vector<Vec3> points;
  for (TriId t : surface.tris.ids()) {
    const auto c = surface.corners(t);
    points.push_back((c[0] + c[1] + c[2]) / 3);
  }
  return points;
}

/// The lattice whose outer points are the corners of the box; two or more along each axis.
PointLattice lattice_in(const Box3& box, const std::array<std::size_t, 3>& counts) {
  PointLattice lattice;
  lattice.origin = box.lo;
  lattice.counts = counts;
  const Vec3 extent = box.extent();
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    lattice.steps[axis] = lattice.steps[axis] * (extent[a] / static_cast<double>(counts[axis] - 1));
  }
  return lattice;
}

}  // namespace

SizeRule function_rule(const nb::object& function) {
  // Let go of with the lock too, whichever thread is the last to hold it.
  const std::shared_ptr<const nb::object> held(new nb::object(function), [](nb::object* f) {
    const nb::gil_scoped_acquire lock;
    delete f;
  });
  PointField field;
  field.between = [held](std::span<const Vec3> places, std::span<double> sizes) {
    const nb::gil_scoped_acquire lock;
    const auto [kept, owner] = keep(std::vector<Vec3>(places.begin(), places.end()));
    const auto values = nb::cast<Sizes>((*held)(view_points(*kept, owner)));
    if (values.shape(0) != sizes.size())
      throw Error(ErrorCode::BadArgument, "the function gives another number of values", kName);
    std::copy_n(values.data(), sizes.size(), sizes.begin());
  };
  return field_rule(std::move(field));
}

SizeRule points_rule(const AnyArray& points, const AnyArray& sizes) {
  PointField field;
  field.points = to_points(points, "sizes: the points");
  field.values = to_numbers(sizes, field.points.size(), "sizes: those of the points");
  return field_rule(std::move(field));
}

SizeRule lattice_rule(const AnyArray& values, const std::array<std::size_t, 3>& counts,
                      const AnyArray& box) {
  const std::vector<double> ends = to_numbers(box, 6, "sizes: the box");
  const Box3 sides = {{ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}};
  return field_rule(make_lattice_field(
      lattice_in(sides, counts),
      to_numbers(values, counts[0] * counts[1] * counts[2], "sizes: the lattice")));
}

SizeRule surface_rule(const TriMesh& surface, const AnyArray& sizes) {
  const std::size_t count = sizes.ndim() == 1 ? sizes.shape(0) : 0;
  if (count == 0 || (count != surface.num_verts() && count != surface.num_tris()))
    throw Error(ErrorCode::BadArgument,
                fmt::format("has {} values; give one per vertex ({}) or per face ({}) of the "
                            "surface",
                            count, surface.num_verts(), surface.num_tris()),
                kName);
  PointField field;
  field.values = to_numbers(sizes, count, kName);
  if (surface.find_problem()) return field_rule({});  // meshing tells the problem
  const bool is_by_vertex = count == surface.num_verts();
  field.points = is_by_vertex ? surface.positions.raw() : centroids(surface);
  const nb::gil_scoped_release released;
  const auto tree = std::make_shared<const SurfaceTree>(surface);
  field.between = [tree, is_by_vertex, values = field.values](std::span<const Vec3> places,
                                                              std::span<double> numbers) {
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const auto nearest = tree->closest(places[i]))
        numbers[i] = is_by_vertex ? interpolate(tree->surface(), *nearest, values)
                                  : values[nearest->tri.index()];
  };
  SizeRule rule = field_rule(std::move(field));
  rule.is_at_surface = true;
  return rule;
}

}  // namespace hexwright::python
