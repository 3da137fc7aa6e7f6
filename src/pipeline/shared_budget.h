// One budget for parts that are meshed one after another.
#pragma once

#include <vector>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// What the options allow for all parts together. Each part may use what is left, less half of what
/// the later ones' areas would give them; and half of what its own gives it in any case, for grids
/// that are refined may come out larger than was allowed.
class SharedBudget {
 public:
  SharedBudget(const MeshOptions& options, const std::vector<TriMesh>& parts);

  /// The options of the next part.
  MeshOptions allow(MeshOptions part) const;
  /// Its result.
  void spend(const MeshResult& part);

 private:
  std::size_t left(double all, double spent) const;

  std::vector<double> later_area_;  ///< per part: of it and all after it, share of the whole
  std::size_t next_ = 0;
  double hexes_, loop_hexes_, cells_;  ///< all
  double spent_ = 0, loop_spent_ = 0;  ///< hexes
};

}  // namespace hexwright
