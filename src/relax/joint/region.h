// The hexes and vertices of one joint solve, numbered from 0 so that it works on small arrays.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "relax/joint/energy.h"
#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Immutable. Two regions without a hex in common can be solved at once.
class JointRegion {
 public:
  /// `hexes`: all that touch a movable vertex.
  JointRegion(const FitState& state, std::vector<VertId> movable, std::vector<HexId> hexes);

  std::size_t num_movable() const { return shape_.num_movable; }
  const std::vector<HexId>& hexes() const { return hexes_; }
  /// By local number: movable vertices first.
  const std::vector<VertId>& verts() const { return verts_; }
  const JointShape& shape() const { return shape_; }
  /// The vertices of hexes()[k].
  std::span<const std::array<LocalVert, 8>> local_hexes() const { return local_hexes_; }
  bool is_movable(LocalVert v) const { return v < shape_.num_movable; }

 private:
  void number_verts(const FitState& state, const std::vector<VertId>& movable);
  void find_corners();
  void find_edges(const FitState& state);

  std::vector<HexId> hexes_;
  std::vector<VertId> verts_;
  std::vector<std::array<LocalVert, 8>> local_hexes_;
  JointShape shape_;
};

}  // namespace hexwright::relax
