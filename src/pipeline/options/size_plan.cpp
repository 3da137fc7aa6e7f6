// Sizes become a lattice and bounds of its cells.
#include "hexwright/pipeline/size_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/shape_diameter.h"

#include "geometry/tree/point_tree.h"
#include "pipeline/options/size_places.h"

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
constexpr double kRounding = 1e-9;

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

/// The least that fields ask for in the object's box, at places an eighth of it apart and at their
/// own points; 0 = nothing.
double least_of_fields(const SizeWishes& wishes, const Target& target) {
  constexpr int kParts = 4;  // along each axis
  const Vec3 part = target.tree.box().extent() / kParts;
  double least = kInfinity;
  for (const SizeRule& rule : wishes.rules) {
    if (rule.where != SizeRule::Where::Field) continue;
    const SizeField::Limit limit = limit_by_rule(rule, target);
    for (int x = 0; x < kParts; ++x)
      for (int y = 0; y < kParts; ++y)
        for (int z = 0; z < kParts; ++z) {
          const Vec3 lo = target.tree.box().lo + Vec3{x * part.x, y * part.y, z * part.z};
          least = std::min(least, limit({lo, lo + part}));
        }
  }
  return std::isfinite(least) ? std::max(least, to_unit(wishes.min_size, target)) : 0;
}

bool has_field(const SizeWishes& wishes) {
  return std::any_of(wishes.rules.begin(), wishes.rules.end(),
                     [](const SizeRule& rule) { return rule.where == SizeRule::Where::Field; });
}

/// The edge that a level of the lattice is to have exactly, in unit coordinates; 0 = any.
double lattice_edge(const MeshOptions& wishes, const Target& target, const WallWidths& walls) {
  const SizeWishes& w = wishes.sizes;
  if (w.size.is_given()) return to_unit(w.size, target);
  if (w.max_size.is_given()) return to_unit(w.max_size, target);
  for (const SizeRule& rule : w.rules)
    if (rule.size.is_given()) return to_unit(rule.size, target);
  if (const double least = least_of_fields(w, target); least > 0) return least;
  return w.across > 0 ? common_width(walls.widths) / w.across : 0;
}

/// A unit of lengths in the surface's.
double in_unit(double metres, double surface_metres) {
  if (!(surface_metres > 0))
    throw Error(ErrorCode::BadArgument,
                "a length has a unit, but nobody knows the surface's; give it, e.g. --unit mm");
  return metres / surface_metres;
}

}  // namespace

bool is_level_given(const MeshOptions& wishes) { return wishes.loop_extra_levels == 0; }

MeshOptions resolve_units(MeshOptions options) {
  const double unit = options.sizes.unit;
  const auto resolve = [unit](double& value, double& metres) {
    if (metres > 0) value *= in_unit(metres, unit);
    metres = 0;
  };
  SizeWishes& w = options.sizes;
  for (Length* length : {&w.size, &w.max_size, &w.min_size}) resolve(length->value, length->metres);
  for (SizeRule& rule : w.rules)
    for (Length* length : {&rule.size, &rule.distance}) resolve(length->value, length->metres);
  if (w.margin)
    for (Margin& margin : *w.margin) resolve(margin.value, margin.metres);
  for (LayerSpec& spec : options.layers.specs)
    if (spec.first.unit == LayerLength::Unit::Metre)
      spec.first = {spec.first.value * in_unit(1, unit), LayerLength::Unit::World};
  return options;
}

MeshOptions resolve_sizes(const MeshOptions& wishes, const TriMesh& surface) {
  MeshOptions options = resolve_units(wishes);
  const SizeWishes& sizes = options.sizes;
  if (!sizes.any() && !sizes.has_domain()) return options;
  if (surface.find_problem()) return options;  // its preparation says so
  const double diagonal = bounding_box(surface).diagonal();
  check_size_wishes(sizes, wishes.fit.carve.side, diagonal);
  options.mean_share = 0;
  if (sizes.size.is_given() || sizes.cells > 0 || has_field(sizes))
    options.even.transition_cost = 0;
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
  SizeField field;
  field.least_edge = to_unit(w.min_size, target);
  field.is_exact = w.size.is_given();
  field.growth = w.growth;
  if (is_level_given(wishes)) field.deepest = wishes.sizing.max_level;
  const auto add_everywhere = [&](const Length& length) {
    field.limits.push_back([size = to_unit(length, target)](const Box3&) { return size; });
  };
  if (w.max_size.is_given()) add_everywhere(w.max_size);
  if (w.size.is_given() && side == Side::Inside) add_everywhere(w.size);
  if (w.size.is_given() && side != Side::Inside)
    field.limits.push_back(limit_at_object(target, side, to_unit(w.size, target)));
  for (const SizeRule& rule : w.rules) field.limits.push_back(limit_by_rule(rule, target));
  if (!walls.widths.empty()) field.limits.push_back(limit_across(walls, w.across));
  return field;
}

/// The edge of cells of --max-level, less rounding; 0 = it was not given.
double least_edge(const MeshOptions& wishes, double root_edge) {
  if (!is_level_given(wishes)) return 0;
  return std::ldexp(root_edge, -wishes.sizing.max_level) * (1 - kRounding);
}

void check_levels(const MeshOptions& wishes, const Target& target, double root_edge) {
  const double least = least_edge(wishes, root_edge);
  const auto check = [&](const Length& length, const std::string& option) {
    const double size = to_unit(length, target);
    if (!length.is_given() || size >= least) return;
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("{} needs cells of level {}, but --max-level is {}; leave one out", option,
                    static_cast<int>(std::ceil(std::log2(root_edge / size) - kRounding)),
                    wishes.sizing.max_level));
  };
  check(wishes.sizes.size, "--size");
  check(wishes.sizes.max_size, "--max-size");
  for (const SizeRule& rule : wishes.sizes.rules) check(rule.size, "--refine " + rule.text);
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

Box3 object_box(const Target& target) {
  const Box3& unit = target.tree.box();
  return {target.frame.to_world(unit.lo), target.frame.to_world(unit.hi)};
}

namespace {

/// The domain around the object; absent: inside, or none was asked for.
std::optional<Box3> choose_box(const MeshOptions& wishes, const Target& target) {
  const Box3& unit = target.tree.box();
  const auto box = find_domain_box(wishes, object_box(target));
  if (!box) return {};
  const Box3 domain = {target.frame.to_unit(box->lo), target.frame.to_unit(box->hi)};
  for (int a = 0; a < 3; ++a)
    if (domain.hi[a] <= unit.lo[a] || domain.lo[a] >= unit.hi[a])
      throw Error(ErrorCode::BadArgument,
                  "--box does not meet the object; its coordinates are those of the surface");
  return domain;
}

/// Inside, the lattice that goes with the surface; outside, the one that fills the box.
std::optional<SizedDomain> choose_domain(const MeshOptions& wishes, const Target& target,
                                         const WallWidths& walls, const std::optional<Box3>& box) {
  const double edge = lattice_edge(wishes, target, walls);
  if (wishes.fit.carve.side == Side::Inside) {
    if (edge <= 0) return {};
    return fit_lattice(target.surface(), edge, wishes.sizing.margin);
  }
  if (!box) return {};
  const Vec3 extent = box->extent();
  const double coarsest = std::min({extent.x, extent.y, extent.z}) / kLeastRoots;
  return fill_box(*box, edge > 0 ? edge : coarsest, kLeastRoots);
}

/// How thin walls are is nobody's wish: a level that is too coarse for them binds.
void warn_of_thin_walls(const MeshOptions& wishes, const WallWidths& walls, double root_edge,
                        const Context& context) {
  if (walls.widths.empty()) return;
  const double least = least_edge(wishes, root_edge);
  const auto num_thin = std::count_if(walls.widths.begin(), walls.widths.end(), [&](double width) {
    return kWidthRoom * width / wishes.sizes.across < least;
  });
  if (num_thin > 0)
    context.warn(fmt::format(
        "--max-level {} leaves {:.1f}% of the walls with fewer cells than --across {} asks for; "
        "raise --max-level",
        wishes.sizing.max_level,
        100 * static_cast<double>(num_thin) / static_cast<double>(walls.widths.size()),
        wishes.sizes.across));
}

}  // namespace

SizePlan plan_sizes(const MeshOptions& wishes, const Target& target, const Context& context) {
  const WallWidths walls = measure_walls(wishes, target, context);
  SizePlan sizes;
  sizes.field = make_size_field(wishes, target, walls);
  sizes.box = choose_box(wishes, target);
  sizes.domain = choose_domain(wishes, target, walls, sizes.box);
  const double root_edge = sizes.domain
                               ? sizes.domain->domain.frame.root_size
                               : root_frame(target.tree.box(), wishes.sizing.margin).root_size;
  check_levels(wishes, target, root_edge);
  warn_of_thin_walls(wishes, walls, root_edge, context);
  return sizes;
}

}  // namespace hexwright
