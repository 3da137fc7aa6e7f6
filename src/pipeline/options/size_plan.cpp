// Places become distance functions, sizes a lattice.
#include "hexwright/pipeline/size_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hexwright/base/error.h"
#include "hexwright/base/name_pattern.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/geometry/surface_names.h"

#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

/// With a size and no tolerance, boundaries may be off by this share of the edge: what a quad of
/// this edge leaves of a circle of twice its length, about.
constexpr double kToleranceOfSize = 0.25;
constexpr double kLargestTolerance = 0.25;  // of the diagonal
/// Between samples of walls, share of the diagonal.
constexpr double kWallSpacing = 1.0 / 120;
/// What rays measure may be less than a wall by so much.
constexpr double kWidthRoom = 1.01;
/// One of so many samples may be on a thinner wall than those that the lattice is made for.
constexpr std::size_t kThinnest = 10;
/// Roots along the shortest side of a box.
constexpr int kLeastRoots = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance of a point, in unit coordinates, from a place, 0 in it.
using Distance = std::function<double(const Vec3&)>;

double distance_to_box(const Vec3& lo, const Vec3& hi, const Vec3& p) {
  const Vec3 beyond = max(max(lo - p, p - hi), Vec3{});
  return norm(beyond);
}

double distance_to_cylinder(const SizeRule& rule, const Vec3& p) {
  const Vec3 axis = rule.b - rule.a;
  const double length = norm(axis);
  const Vec3 d = length > 0 ? axis / length : Vec3{0, 0, 1};
  const double along = dot(p - rule.a, d);
  const double off = std::max(0.0, norm(p - rule.a - d * along) - rule.radius);
  const double beyond = std::max({0.0, -along, along - length});
  return std::sqrt(off * off + beyond * beyond);
}

/// Names that a pattern fits, as flags; refuses a pattern that fits none.
std::vector<char> match_names(const SizeRule& rule, const std::vector<std::string>& names,
                              const char* what) {
  std::vector<char> fits;
  for (const std::string& name : names) fits.push_back(matches_pattern(rule.pattern, name));
  if (std::find(fits.begin(), fits.end(), 1) != fits.end()) return fits;
  std::vector<std::string> known;
  for (const std::string& name : names)
    if (!name.empty()) known.push_back(name);
  if (known.empty())
    throw Error(ErrorCode::BadArgument,
                fmt::format("--refine {}: the surface has no names of {}; name parts of it with "
                            "--patch NAME=RULE",
                            rule.text, what));
  throw Error(ErrorCode::BadArgument, fmt::format("--refine {}: fits none of the {} {}", rule.text,
                                                  what, fmt::join(known, ", ")));
}

Distance distance_to_tree(TriMesh triangles) {
  const auto tree = std::make_shared<const SurfaceTree>(std::move(triangles));
  return [tree](const Vec3& p) { return tree->distance(p); };
}

Distance distance_to_patches(const SizeRule& rule, const Target& target) {
  const TriMesh& surface = target.surface();
  const std::vector<char> fits = match_names(
      rule, surface.group.empty() ? std::vector<std::string>() : surface.group_names, "patches");
  TriMesh part;
  part.positions = surface.positions;
  for (TriId t : surface.tris.ids())
    if (const std::int32_t g = surface.group[t]; g >= 0 && fits[static_cast<std::size_t>(g)])
      part.tris.push_back(surface.tris[t]);
  return distance_to_tree(std::move(part));
}

/// Segments as triangles without area.
Distance distance_to_curves(const SizeRule& rule, const Target& target) {
  const auto names = name_curves(target.surface(), target.features);
  const std::vector<char> fits = match_names(rule, names.raw(), "curves");
  TriMesh part;
  part.positions = target.surface().positions;
  for (CurveId c : target.features.curves.ids()) {
    if (!fits[c.index()]) continue;
    const auto& verts = target.features.curves[c].verts;
    for (std::size_t k = 0; k + 1 < verts.size(); ++k)
      part.tris.push_back({verts[k], verts[k + 1], verts[k + 1]});
  }
  return distance_to_tree(std::move(part));
}

/// In the world, where the rule's numbers count; lengths back to unit ones.
Distance distance_in_world(const SizeRule& rule, const Similarity& frame) {
  return [rule, frame](const Vec3& unit) {
    const Vec3 p = frame.to_world(unit);
    double d = 0;
    switch (rule.where) {
      case SizeRule::Where::Box:
        d = distance_to_box(rule.a, rule.b, p);
        break;
      case SizeRule::Where::Ball:
        d = std::max(0.0, distance(p, rule.a) - rule.radius);
        break;
      default:
        d = distance_to_cylinder(rule, p);
    }
    return frame.length_to_unit(d);
  };
}

Distance distance_to(const SizeRule& rule, const Target& target) {
  switch (rule.where) {
    case SizeRule::Where::Patch:
      return distance_to_patches(rule, target);
    case SizeRule::Where::Curve:
      return distance_to_curves(rule, target);
    case SizeRule::Where::Near:
      return distance_to_tree(to_unit(*rule.surface, target.frame));
    default:
      return distance_in_world(rule, target.frame);
  }
}

/// Cells that may come within `reach` of the place are no larger than `size`.
SizeField::Limit limit_near(Distance distance, double size, double reach) {
  return [distance = std::move(distance), size, reach](const Box3& cell) {
    return distance(cell.center()) <= reach + cell.diagonal() / 2 ? size : kInfinity;
  };
}

/// The surface, and the inside where that is meshed as well.
Distance distance_to_object(const Target& target, Side side) {
  return [&target, side](const Vec3& p) {
    if (side == Side::Both && target.tree.is_inside(p)) return 0.0;
    return target.tree.distance(p);
  };
}

/// Walls of the solid, or of gaps outside, that rays at samples of the surface found.
struct WallWidths {
  std::vector<Vec3> points;
  std::vector<double> widths;
  double spacing = 0;
};

WallWidths measure_walls(const MeshOptions& wishes, const Target& target, const Context& context) {
  const Side side = wishes.fit.carve.side;
  WallWidths walls;
  if (wishes.sizes.across == 0) return walls;
  walls.spacing = kWallSpacing * target.diagonal();
  for (const WallSample& s : sample_opposite_walls(target.tree, walls.spacing, context)) {
    const double width = side == Side::Inside    ? s.inner
                         : side == Side::Outside ? s.outer
                                                 : std::min(s.inner, s.outer);
    if (!std::isfinite(width)) continue;
    walls.points.push_back(s.point);
    walls.widths.push_back(width);
  }
  return walls;
}

/// Width over the number of cells, within walls.
SizeField::Limit limit_across(const WallWidths& walls, int count) {
  const auto tree = std::make_shared<const PointTree>(walls.points);
  return [tree, widths = walls.widths, spacing = walls.spacing, count](const Box3& cell) {
    const Vec3 extent = cell.extent();
    const double edge = std::max({extent.x, extent.y, extent.z});
    const double room = edge * std::max(1.0, 0.5 * count) + spacing;
    const Vec3 r = {room, room, room};
    double least = kInfinity;
    tree->visit_box({cell.lo - r, cell.hi + r}, [&](std::size_t i) {
      const double reach = widths[i] / 2 + cell.diagonal() / 2 + spacing;
      if (distance(tree->points()[i], cell.center()) <= reach)
        least = std::min(least, kWidthRoom * widths[i] / count);
    });
    return least;
  };
}

/// The width that few walls are thinner than; 0 = there are none.
double common_width(std::vector<double> widths) {
  if (widths.empty()) return 0;
  const auto at = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / kThinnest);
  std::nth_element(widths.begin(), at, widths.end());
  return *at;
}

/// The edge that a level of the lattice is to have exactly, in unit coordinates; 0 = any.
double lattice_edge(const MeshOptions& wishes, const Target& target, const WallWidths& walls) {
  const SizeWishes& w = wishes.sizes;
  const auto to_unit = [&](const Length& length) {
    return length.is_share ? length.value * target.diagonal()
                           : target.frame.length_to_unit(length.value);
  };
  if (w.size.is_given()) return to_unit(w.size);
  if (w.max_size.is_given()) return to_unit(w.max_size);
  if (!w.rules.empty()) return to_unit(w.rules.front().size);
  return w.across > 0 ? common_width(walls.widths) / w.across : 0;
}

}  // namespace

MeshOptions resolve_sizes(const MeshOptions& wishes, const TriMesh& surface) {
  MeshOptions options = wishes;
  const SizeWishes& sizes = wishes.sizes;
  if (!sizes.any() && !sizes.has_domain()) return options;
  if (surface.find_problem()) return options;  // its preparation says so
  const double diagonal = bounding_box(surface).diagonal();
  check_size_wishes(sizes, wishes.fit.carve.side, diagonal);
  options.mean_share = 0;
  if (sizes.size.is_given() || sizes.cells > 0) options.even.transition_cost = 0;
  return resolve_tolerance(std::move(options), diagonal);
}

MeshOptions resolve_tolerance(MeshOptions options, double diagonal) {
  const Length& size = options.sizes.size;
  if (options.is_tolerance_given || !size.is_given() || !(diagonal > 0)) return options;
  const double share = size.is_share ? size.value : size.value / diagonal;
  if (std::isfinite(share))
    options.sizing.tolerance = std::clamp(kToleranceOfSize * share, options.sizing.tolerance,
                                          std::max(options.sizing.tolerance, kLargestTolerance));
  return options;
}

namespace {

SizeField make_size_field(const MeshOptions& wishes, const Target& target,
                          const WallWidths& walls) {
  const SizeWishes& w = wishes.sizes;
  const Side side = wishes.fit.carve.side;
  const auto to_unit = [&](const Length& length) {
    return length.is_share ? length.value * target.diagonal()
                           : target.frame.length_to_unit(length.value);
  };
  SizeField field;
  field.least_edge = to_unit(w.min_size);
  field.is_exact = w.size.is_given();
  field.growth = w.growth;
  const auto add_everywhere = [&](double size) {
    field.limits.push_back([size](const Box3&) { return size; });
  };
  if (w.max_size.is_given()) add_everywhere(to_unit(w.max_size));
  if (w.size.is_given() && side == Side::Inside) add_everywhere(to_unit(w.size));
  if (w.size.is_given() && side != Side::Inside)
    field.limits.push_back(limit_near(distance_to_object(target, side), to_unit(w.size), 0));
  for (const SizeRule& rule : w.rules)
    field.limits.push_back(
        limit_near(distance_to(rule, target), to_unit(rule.size), to_unit(rule.distance)));
  if (!walls.widths.empty()) field.limits.push_back(limit_across(walls, w.across));
  return field;
}

}  // namespace

std::optional<Box3> find_domain_box(const MeshOptions& wishes, const Box3& object) {
  const SizeWishes& w = wishes.sizes;
  if (wishes.fit.carve.side == Side::Inside) return {};
  if (w.box) return w.box;
  if (!w.margin && !w.any()) return {};
  const Vec3 extent = object.extent();
  const double length = std::max({extent.x, extent.y, extent.z});
  Box3 box = object;
  for (int side = 0; side < 6; ++side) {
    const Margin m =
        w.margin ? (*w.margin)[static_cast<std::size_t>(side)] : Margin{wishes.sizing.margin, true};
    const double room = m.is_multiple ? m.value * length : m.value;
    (side % 2 == 0 ? box.lo : box.hi)[side / 2] += side % 2 == 0 ? -room : room;
  }
  return box;
}

namespace {

/// The lattice and the domain; absent: one root cube around the object.
std::optional<SizedDomain> choose_domain(const MeshOptions& wishes, const Target& target,
                                         const WallWidths& walls) {
  double edge = lattice_edge(wishes, target, walls);
  if (wishes.fit.carve.side == Side::Inside) {
    if (edge <= 0) return {};
    return fit_lattice(target.surface(), edge, wishes.sizing.margin);
  }
  const Box3& unit = target.tree.box();
  const Box3 object = {target.frame.to_world(unit.lo), target.frame.to_world(unit.hi)};
  const auto box = find_domain_box(wishes, object);
  if (!box) return {};
  const Box3 domain = {target.frame.to_unit(box->lo), target.frame.to_unit(box->hi)};
  for (int a = 0; a < 3; ++a)
    if (domain.hi[a] <= unit.lo[a] || domain.lo[a] >= unit.hi[a])
      throw Error(ErrorCode::BadArgument,
                  "--box does not meet the object; its coordinates are those of the surface");
  const Vec3 extent = domain.extent();
  if (edge <= 0) edge = std::min({extent.x, extent.y, extent.z}) / kLeastRoots;
  return fill_box(domain, edge, kLeastRoots);
}

}  // namespace

SizePlan plan_sizes(const MeshOptions& wishes, const Target& target, const Context& context) {
  const WallWidths walls = measure_walls(wishes, target, context);
  return {make_size_field(wishes, target, walls), choose_domain(wishes, target, walls)};
}

}  // namespace hexwright
