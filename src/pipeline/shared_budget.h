// One budget for parts that are meshed one after another.
#pragma once

#include <vector>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// What the options allow for all parts together. Each part may use what is left, less half of what
/// the later ones' areas would give them.
class SharedBudget {
 public:
  SharedBudget(const MeshOptions& options, const std::vector<TriMesh>& parts);

  /// The options of the next part.
  MeshOptions allow(MeshOptions part) const;
  /// Its result.
  void spend(const MeshResult& part);

 private:
  double share() const;

  std::vector<double> later_area_;  ///< per part: of it and all after it, share of the whole
  std::size_t next_ = 0;
  double hexes_, loop_hexes_, cells_;  ///< all
  double spent_ = 0, loop_spent_ = 0;  ///< hexes
};

}  // namespace hexwright
