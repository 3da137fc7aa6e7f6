// Places become distance functions.
#include "pipeline/options/size_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hexwright/base/error.h"
#include "hexwright/base/name_pattern.h"
#include "hexwright/geometry/surface_names.h"

#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kInside = "inside";
constexpr const char* kOutside = "outside";

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

/// The triangles of the groups that a rule names.
TriMesh named_part(const SizeRule& rule, const TriMesh& surface, const char* what) {
  const std::vector<char> fits = match_names(
      rule, surface.group.empty() ? std::vector<std::string>() : surface.group_names, what);
  TriMesh part;
  part.positions = surface.positions;
  for (TriId t : surface.tris.ids())
    if (const std::int32_t g = surface.group[t]; g >= 0 && fits[static_cast<std::size_t>(g)])
      part.tris.push_back(surface.tris[t]);
  return part;
}

Distance distance_to_patches(const SizeRule& rule, const Target& target) {
  return distance_to_tree(named_part(rule, target.surface(), "patches"));
}

/// In or outside of the rule's own triangles, whichever way they are turned.
Distance distance_to_region(const SizeRule& rule, const Target& target) {
  require_closed(rule, *rule.surface);
  const auto tree = std::make_shared<const SurfaceTree>(to_unit(*rule.surface, target.frame));
  return [tree, is_outside = rule.is_outside](const Vec3& p) {
    const bool is_inside = std::abs(tree->winding_number(p)) > 0.5;
    return is_inside != is_outside ? 0 : tree->distance(p);
  };
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
    case SizeRule::Where::Region:
      return distance_to_region(rule, target);
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

double checked_size(double size, const Vec3& place, const SizeRule& rule) {
  if (size > 0) return size;
  throw Error(
      ErrorCode::BadArgument,
      fmt::format("the size at ({:.6g}, {:.6g}, {:.6g}) is {:.6g}; give lengths above 0, or "
                  "infinity where nothing is asked for",
                  place.x, place.y, place.z, size),
      rule.text);
}

/// The least of what a function of places says at three by three by three of a box.
double least_between(const SizeRule& rule, const Box3& box, const Similarity& frame) {
  const Vec3 half = box.extent() / 2;
  std::array<Vec3, 27> places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto step = [i](std::size_t stride) { return static_cast<double>(i / stride % 3); };
    places[i] = frame.to_world(box.lo + Vec3{step(1) * half.x, step(3) * half.y, step(9) * half.z});
  }
  std::array<double, 27> sizes;
  sizes.fill(kInfinity);
  rule.field->between(places, sizes);
  double least = kInfinity;
  for (std::size_t i = 0; i < places.size(); ++i)
    least = std::min(least, checked_size(sizes[i], places[i], rule));
  return least;
}

/// The least over the field's points in the cell, and over places of the cell.
SizeField::Limit limit_by_field(const SizeRule& rule, const Target& target) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < rule.field->points.size(); ++i) {
    checked_size(rule.field->values[i], rule.field->points[i], rule);
    points.push_back(target.frame.to_unit(rule.field->points[i]));
  }
  const auto tree = std::make_shared<const PointTree>(std::move(points));
  return [rule, tree, &target](const Box3& cell) {
    if (rule.is_at_surface && target.tree.distance(cell.center()) > cell.diagonal() / 2)
      return kInfinity;
    double least = kInfinity;
    tree->visit_box(cell, [&](std::size_t i) { least = std::min(least, rule.field->values[i]); });
    if (rule.field->between) least = std::min(least, least_between(rule, cell, target.frame));
    return target.frame.length_to_unit(least);
  };
}

/// The first vertex at the place of each: files of loose triangles repeat them.
IdVector<VertId, VertId> first_at_place(const TriMesh& surface) {
  std::vector<VertId> order;
  for (VertId v : surface.positions.ids()) order.push_back(v);
  const auto at = [&](VertId v) {
    const Vec3& p = surface.positions[v];
    return std::tie(p.x, p.y, p.z);
  };
  std::stable_sort(order.begin(), order.end(), [&](VertId a, VertId b) { return at(a) < at(b); });
  IdVector<VertId, VertId> first(surface.num_verts());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && at(order[i - 1]) == at(order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

/// Whether every edge is passed as often one way as the other.
bool is_closed(const TriMesh& surface) {
  const IdVector<VertId, VertId> first = first_at_place(surface);
  std::vector<std::pair<VertId, VertId>> edges[2];
  for (const auto& tri : surface.tris)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertId a = first[tri[k]], b = first[tri[(k + 1) % 3]];
      if (a != b) edges[a < b ? 0 : 1].emplace_back(std::min(a, b), std::max(a, b));
    }
  for (auto& list : edges) std::sort(list.begin(), list.end());
  return !surface.tris.empty() && edges[0] == edges[1];
}

bool has_group(const TriMesh& surface, const std::string& name) {
  return std::find(surface.group_names.begin(), surface.group_names.end(), name) !=
         surface.group_names.end();
}

}  // namespace

double to_unit(const Length& length, const Target& target) {
  return length.is_share ? length.value * target.diagonal()
                         : target.frame.length_to_unit(length.value);
}

SizeField::Limit limit_by_rule(const SizeRule& rule, const Target& target) {
  if (rule.where == SizeRule::Where::Field) return limit_by_field(rule, target);
  return limit_near(distance_to(rule, target), to_unit(rule.size, target),
                    to_unit(rule.distance, target));
}

SizeField::Limit limit_at_object(const Target& target, Side side, double size) {
  return limit_near(
      [&target, side](const Vec3& p) {
        return side == Side::Both && target.tree.is_inside(p) ? 0.0 : target.tree.distance(p);
      },
      size, 0);
}

void require_closed(const SizeRule& rule, const TriMesh& region) {
  if (is_closed(region)) return;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--refine {}: its triangles enclose no region; name all groups of a "
                          "closed body, or use patch:NAME=SIZE,DISTANCE",
                          rule.text));
}

void find_regions(std::vector<SizeRule>& rules, const Target& target) {
  const TriMesh& surface = target.surface();
  for (SizeRule& rule : rules) {
    if (rule.where != SizeRule::Where::Region || rule.surface) continue;
    const bool is_any =
        (rule.pattern == kInside || rule.pattern == kOutside) && !has_group(surface, rule.pattern);
    rule.is_outside = is_any && rule.pattern == kOutside;
    TriMesh part = is_any ? surface : named_part(rule, surface, "regions");
    require_closed(rule, part);
    rule.surface = std::make_shared<const TriMesh>(to_world(std::move(part), target.frame));
  }
}

}  // namespace hexwright
