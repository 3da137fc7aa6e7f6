// Which triangles of a surface come near each other, cross, or touch.
//
// Based on: Möller, "A fast triangle-triangle intersection test", Journal of Graphics Tools 2(2),
// 1997 (edges of one against the other). Differs: a crossing must be of a given depth, so that
// what rounding decides is none.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

using Corners = std::array<Vec3, 3>;

/// Where an edge of one triangle passes through the other, with both its ends farther than `depth`
/// from the other's plane; absent when none does. Coplanar triangles do not cross.
std::optional<Vec3> find_crossing(const Corners& a, const Corners& b, double depth);

/// Whether some points of the two are at most `gap` apart.
bool are_within(const Corners& a, const Corners& b, double gap);

/// A surface that others are held against.
class NearSurface {
 public:
  /// Keeps a reference.
  explicit NearSurface(const TriMesh& surface);
  ~NearSurface();

  /// Whether some points of the two are at most `gap` apart.
  bool is_within(const TriMesh& other, double gap) const;

 private:
  struct Boxes;
  const TriMesh& surface_;
  Box3 box_;
  std::unique_ptr<const Boxes> boxes_;
};

struct TriPair {
  TriId a, b;  ///< a < b
};

/// All pairs whose boxes come within `gap` of each other and that `accept` takes, in increasing
/// order. `accept` is called from several threads.
std::vector<TriPair> find_near_pairs(const TriMesh& surface, double gap,
                                     FunctionRef<bool(TriId a, TriId b)> accept);

}  // namespace hexwright
