// Labels by the faces they are on, and the faces that have none.
#include "io/solver/boundary_sides.h"

#include <algorithm>
#include <map>

#include "hexwright/base/error.h"

namespace hexwright::io {
namespace {

std::size_t number_of(HexFace face) {
  return 6 * face.hex.index() + static_cast<std::size_t>(face.lf);
}

std::vector<std::size_t> find_patches(const SetTable& table, std::size_t num_quads) {
  std::vector<std::size_t> quad_to_patch(num_quads);
  for (std::size_t p = 0; p < table.patches.size(); ++p)
    for (std::size_t q : table.patches[p].members) quad_to_patch[q] = p;
  return quad_to_patch;
}

std::string free_name(const SetTable& table, std::string name) {
  const auto is_taken = [&] {
    for (const auto* sets : {&table.regions, &table.patches, &table.patch_groups, &table.curves})
      for (const NamedSet& set : *sets)
        if (set.name == name) return true;
    return false;
  };
  while (is_taken()) name += "_";
  return name;
}

}  // namespace

BoundarySides find_boundary_sides(const HexMesh& mesh, const SetTable& table) {
  BoundarySides sides;
  sides.neighbors = compute_hex_neighbors(mesh);
  if (!sides.neighbors.non_conforming.empty())
    throw Error(ErrorCode::BadArgument,
                "hex " + std::to_string(sides.neighbors.non_conforming[0].hex.value()) +
                    " has a face of three or more hexes, which this format has no place for; "
                    "repair the mesh");
  const std::vector<HexFace> quad_sides = find_quad_sides(mesh);
  const auto quad_to_patch = find_patches(table, quad_sides.size());
  std::map<std::size_t, std::size_t> face_to_patch;
  for (std::size_t q = 0; q < quad_sides.size(); ++q) {
    const HexFace face = quad_sides[q];
    if (sides.neighbors.neighbor[face.hex][static_cast<std::size_t>(face.lf)].is_valid())
      sides.inner.push_back({face, q, quad_to_patch[q]});
    else
      face_to_patch.try_emplace(number_of(face), quad_to_patch[q]);
  }
  for (const HexFace& face : sides.neighbors.boundary) {
    const auto found = face_to_patch.find(number_of(face));
    const bool is_labeled = found != face_to_patch.end();
    sides.outer.push_back({face, is_labeled ? found->second : table.patches.size()});
    sides.has_unlabeled = sides.has_unlabeled || !is_labeled;
  }
  std::stable_sort(sides.outer.begin(), sides.outer.end(),
                   [](const BoundarySide& a, const BoundarySide& b) { return a.patch < b.patch; });
  sides.unlabeled_name = free_name(table, "unlabeled");
  return sides;
}

}  // namespace hexwright::io
