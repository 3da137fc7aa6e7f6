#include "geometry/topology/bodies.h"

#include <optional>
#include <utility>

#include "hexwright/geometry/surface_tree.h"

#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

void append(ClosedPiece& body, const ClosedPiece& cavity) {
  append(body.mesh, cavity.mesh);
  body.tri_to_surface.insert(body.tri_to_surface.end(), cavity.tri_to_surface.begin(),
                             cavity.tri_to_surface.end());
  body.vert_to_surface.insert(body.vert_to_surface.end(), cavity.vert_to_surface.begin(),
                              cavity.vert_to_surface.end());
}

bool holds(const Box3& outer, const Box3& inner) {
  return outer.contains(inner.lo) && outer.contains(inner.hi);
}

/// Finds the solid that a cavity is in. Trees are made when asked for, once: a solid may have
/// thousands of cavities, and most have none.
class OwnerFinder {
 public:
  explicit OwnerFinder(const std::vector<ClosedPiece>& solids)
      : solids_(solids), trees_(solids.size()) {}

  /// The smallest of the solids around a cavity, or -1.
  int find(const ClosedPiece& cavity) {
    const auto c = cavity.mesh.corners(TriId(0));
    const Vec3 point = (c[0] + c[1] + c[2]) / 3;
    int owner = -1;
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (!holds(solids_[i].box, cavity.box)) continue;
      if (owner >= 0 && solids_[i].volume >= solids_[static_cast<std::size_t>(owner)].volume)
        continue;
      if (!trees_[i]) trees_[i].emplace(solids_[i].mesh);
      if (trees_[i]->is_inside(point)) owner = static_cast<int>(i);
    }
    return owner;
  }

 private:
  const std::vector<ClosedPiece>& solids_;
  std::vector<std::optional<SurfaceTree>> trees_;
};

}  // namespace

std::vector<ClosedPiece> find_bodies(const TriMesh& surface) {
  std::vector<ClosedPiece> solids, cavities;
  for (ClosedPiece& piece : split_closed_pieces(surface))
    (piece.volume > 0 ? solids : cavities).push_back(std::move(piece));
  if (solids.size() < 2) return {};
  OwnerFinder finder(solids);
  std::vector<int> owners;
  for (const ClosedPiece& cavity : cavities) owners.push_back(finder.find(cavity));
  for (std::size_t i = 0; i < cavities.size(); ++i)
    if (owners[i] >= 0) append(solids[static_cast<std::size_t>(owners[i])], cavities[i]);
  return solids;
}

}  // namespace hexwright
