// Which names a surface's groups give.
#include "hexwright/geometry/surface_names.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "geometry/topology/surface_edges.h"

namespace hexwright {
namespace {

/// The first group that a triangle has, and whether another has a different one.
struct GroupsInUse {
  std::int32_t first = -1;
  bool are_several = false;
};

GroupsInUse find_groups(const TriMesh& surface) {
  GroupsInUse found;
  for (const std::int32_t group : surface.group) {
    if (group < 0) continue;
    if (found.first < 0) found.first = group;
    found.are_several = found.are_several || group != found.first;
  }
  return found;
}

std::string name_of(const TriMesh& surface, std::int32_t group) {
  return group < 0 ? "" : surface.group_names[static_cast<std::size_t>(group)];
}

}  // namespace

bool has_named_patches(const TriMesh& surface) { return find_groups(surface).are_several; }

std::string name_of_body(const TriMesh& surface) {
  const GroupsInUse found = find_groups(surface);
  return found.are_several ? "" : name_of(surface, found.first);
}

void number_repeated(std::vector<std::string>& names) {
  std::map<std::string, int> count, next;
  for (const std::string& name : names) ++count[name];
  for (std::string& name : names)
    if (!name.empty() && count[name] > 1) {
      const std::string base = name;
      do name = fmt::format("{}.{}", base, ++next[base]);
      while (count.contains(name));  // another group is called so
    }
}

/// The first edge of a curve stands for all: where groups change along it, three patches meet and
/// the curve ends.
IdVector<CurveId, std::string> name_curves(const TriMesh& surface, const FeatureGraph& features) {
  if (!has_named_patches(surface)) return {};
  const SurfaceEdges edges = compute_surface_edges(surface);
  std::vector<std::string> names;
  for (const FeatureCurve& curve : features.curves) {
    const long e = curve.verts.size() < 2 ? -1 : edges.find(curve.verts[0], curve.verts[1]);
    std::vector<std::string> beside;
    if (e >= 0)
      for (const auto& side : edges.sides_of(static_cast<std::size_t>(e)))
        beside.push_back(name_of(surface, surface.group[side.tri]));
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    const bool parts_two = beside.size() == 2 && !beside[0].empty();
    names.push_back(parts_two ? beside[0] + "-" + beside[1] : "");
  }
  number_repeated(names);
  return IdVector<CurveId, std::string>(std::move(names));
}

}  // namespace hexwright
