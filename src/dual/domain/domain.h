// The domain: a union of unit root cubes, with look-up.
#pragma once

#include "dual/domain/split_nodes.h"

namespace hexwright::dual {

class Domain {
 public:
  explicit Domain(const Grid& grid);

  bool contains_root(const LatticeCoord& root) const { return roots_.contains(root); }
  /// Does the domain contain this node of depth `depth`?
  bool contains_node(const LatticeCoord& node, int depth) const {
    return contains_root({node[0] >> depth, node[1] >> depth, node[2] >> depth});
  }
  /// Bit q (x | y << 1 | z << 2) is set when the domain covers the octant q around a point of the
  /// finest lattice.
  int octants_at(const LatticeCoord& point) const;

  /// Is the point on the domain's boundary, at a place where that is not flat?
  bool is_corner_or_crease(const LatticeCoord& point) const;

  /// Do four octants of the domain meet at the point in a twisted path?
  bool is_chiral_corner(const LatticeCoord& point) const;
  /// All such points, on the lattice of the roots.
  std::vector<LatticeCoord> find_chiral_corners() const;

  /// The roots in the grid's order, and a distinct index below num_cell_indices() for each.
  const std::vector<LatticeCoord>& roots() const { return root_list_; }
  std::size_t cell_index(const LatticeCoord& root) const;
  std::size_t num_cell_indices() const { return 8 * roots_.num_groups(); }

  bool is_box() const { return is_box_; }
  /// Some root has no neighbour on either side along an axis.
  bool is_thin() const;
  const LatticeCoord& low() const { return low_; }    ///< lowest root
  const LatticeCoord& high() const { return high_; }  ///< one past the highest root
  std::int32_t root_edge() const { return 1 << finest_level_; }

 private:
  SplitNodes roots_;
  std::vector<LatticeCoord> root_list_;
  int finest_level_ = 0;
  bool is_box_ = false;
  LatticeCoord low_ = {0, 0, 0}, high_ = {0, 0, 0};
};

}  // namespace hexwright::dual
