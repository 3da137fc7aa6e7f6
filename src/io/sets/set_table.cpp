// Groups labels by number, names the groups, and finds the hexes behind labelled quads.
#include "hexwright/io/set_table.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

#include "mesh/quad.h"

namespace hexwright {
namespace {

const std::vector<std::string>& names_of(const HexMesh& mesh, SetKind kind) {
  static const std::vector<std::string> kNone;
  switch (kind) {
    case SetKind::Region:
      return mesh.region_names;
    case SetKind::Patch:
      return mesh.labels.patch_names.raw();
    case SetKind::Curve:
      return mesh.labels.curve_names.raw();
    default:
      return kNone;
  }
}

const std::string* find_name(const std::vector<std::string>& names, std::int32_t number) {
  if (number < 0 || static_cast<std::size_t>(number) >= names.size()) return nullptr;
  const std::string& name = names[static_cast<std::size_t>(number)];
  return name.empty() ? nullptr : &name;
}

/// Elements by number; `number_of(i)` is below -1 only for regions.
template <class NumberOf>
std::vector<NamedSet> group(const HexMesh& mesh, SetKind kind, std::size_t count,
                            NumberOf number_of) {
  std::map<std::int32_t, std::vector<std::size_t>> groups;
  CancelCheck check_cancelled;
  for (std::size_t i = 0; i < count; ++i) {
    check_cancelled();
    groups[number_of(i)].push_back(i);
  }
  std::vector<NamedSet> sets;
  for (auto& [number, members] : groups) {
    const bool is_given = find_name(names_of(mesh, kind), number) != nullptr;
    sets.push_back({kind, set_name(mesh, kind, number), number, std::move(members), is_given});
  }
  return sets;
}

/// "wall" of "wall.3"; empty when there is no number behind the last point.
std::string group_of_name(const std::string& name) {
  const auto point = name.rfind('.');
  if (point == std::string::npos || point == 0 || point + 1 == name.size()) return "";
  const bool is_number = name.find_first_not_of("0123456789", point + 1) == std::string::npos;
  return is_number ? name.substr(0, point) : "";
}

/// Of two patches or more, when no patch has the name itself.
std::vector<NamedSet> group_patches(const std::vector<NamedSet>& patches) {
  std::map<std::string, std::vector<const NamedSet*>> parts;
  for (const NamedSet& patch : patches) parts[group_of_name(patch.name)].push_back(&patch);
  parts.erase("");
  for (const NamedSet& patch : patches) parts.erase(patch.name);
  std::vector<NamedSet> groups;
  for (const auto& [name, members] : parts) {
    if (members.size() < 2) continue;
    NamedSet& set = groups.emplace_back(NamedSet{SetKind::PatchGroup, name, -1, {}, true});
    for (const NamedSet* patch : members)
      set.members.insert(set.members.end(), patch->members.begin(), patch->members.end());
    std::sort(set.members.begin(), set.members.end());
  }
  return groups;
}

template <class Elements>
void append_verts(const Elements& elements, const std::vector<std::size_t>& members,
                  std::vector<VertId>& verts) {
  for (std::size_t i : members)
    verts.insert(verts.end(), elements[i].verts.begin(), elements[i].verts.end());
}

/// By marks: a region's vertices are most of the mesh, each named by eight hexes.
std::vector<VertId> verts_of_hexes(const HexMesh& mesh, const std::vector<std::size_t>& hexes) {
  IdVector<VertId, char> is_used(mesh.num_verts(), 0);
  CancelCheck check_cancelled;
  for (std::size_t h : hexes) {
    check_cancelled();
    for (VertId v : mesh.hexes[HexId(h)]) is_used[v] = 1;
  }
  std::vector<VertId> verts;
  for (VertId v : is_used.ids())
    if (is_used[v]) verts.push_back(v);
  return verts;
}

}  // namespace

const NamedSet& SetTable::at(const std::vector<NamedSet>& sets, std::int32_t number) {
  return *std::lower_bound(sets.begin(), sets.end(), number,
                           [](const NamedSet& set, std::int32_t n) { return set.number < n; });
}

std::string default_set_name(SetKind kind, std::int32_t number) {
  switch (kind) {
    case SetKind::Region:  // the only kind with negative numbers of its own
      return number < 0 ? fmt::format("REGION_MINUS_{}", -std::int64_t{number})
                        : fmt::format("REGION_{}", number);
    case SetKind::Corners:
      return "CORNERS";
    default: {
      const char* name = kind == SetKind::Curve ? "CURVE" : "PATCH";
      return number < 0 ? fmt::format("{}_NONE", name) : fmt::format("{}_{}", name, number);
    }
  }
}

std::string set_name(const HexMesh& mesh, SetKind kind, std::int32_t number) {
  const std::string* name = find_name(names_of(mesh, kind), number);
  return name ? *name : default_set_name(kind, number);
}

SetTable make_set_table(const HexMesh& mesh) {
  const BoundaryLabels& labels = mesh.labels;
  SetTable table;
  table.regions = group(mesh, SetKind::Region, mesh.num_hexes(), [&](std::size_t h) {
    return mesh.region.empty() ? 0 : mesh.region[HexId(h)];
  });
  table.patches = group(mesh, SetKind::Patch, labels.quads.size(),
                        [&](std::size_t q) { return std::max(-1, labels.quads[q].patch.value()); });
  table.patch_groups = group_patches(table.patches);
  table.curves = group(mesh, SetKind::Curve, labels.edges.size(),
                       [&](std::size_t e) { return std::max(-1, labels.edges[e].curve.value()); });
  table.corners =
      group(mesh, SetKind::Corners, labels.corners.size(), [](std::size_t) { return -1; });
  return table;
}

bool is_in_group(const NamedSet& patch, const NamedSet& group) {
  return std::binary_search(group.members.begin(), group.members.end(), patch.members[0]);
}

std::vector<VertId> set_nodes(const HexMesh& mesh, const NamedSet& set) {
  if (set.kind == SetKind::Region) return verts_of_hexes(mesh, set.members);
  std::vector<VertId> verts;
  if (set.kind == SetKind::Curve)
    append_verts(mesh.labels.edges, set.members, verts);
  else if (set.kind == SetKind::Corners)
    for (std::size_t c : set.members) verts.push_back(mesh.labels.corners[c]);
  else
    append_verts(mesh.labels.quads, set.members, verts);
  std::sort(verts.begin(), verts.end());
  verts.erase(std::unique(verts.begin(), verts.end()), verts.end());
  return verts;
}

std::vector<HexFace> find_quad_faces(const HexMesh& mesh, const VertToHex& vert_to_hex,
                                     const std::array<VertId, 4>& quad) {
  const auto wanted = sorted(quad);
  std::vector<HexFace> faces;
  for (const HexCorner& corner : vert_to_hex[quad[0]])
    for (int lf = 0; lf < 6; ++lf)
      if (const HexFace face{corner.hex, lf}; sorted(face_verts(mesh, face)) == wanted)
        faces.push_back(face);
  return faces;
}

std::vector<HexFace> find_quad_sides(const HexMesh& mesh) {
  if (mesh.labels.quads.empty()) return {};
  const VertToHex vert_to_hex(mesh);
  std::vector<HexFace> sides;
  for (const LabeledQuad& quad : mesh.labels.quads) {
    const auto faces = find_quad_faces(mesh, vert_to_hex, quad.verts);
    if (faces.empty())
      throw Error(ErrorCode::BadArgument,
                  fmt::format("labelled quad {} is no face of any hex; remove it from the labels",
                              sides.size()));
    sides.push_back(faces.front());
  }
  return sides;
}

}  // namespace hexwright
