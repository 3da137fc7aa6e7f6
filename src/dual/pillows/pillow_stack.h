// Inserts the pillows of every depth and axis around the core planes of the split nodes.
#pragma once

#include "hexwright/base/context.h"

#include "dual/complex/hex_complex.h"
#include "dual/domain/domain.h"
#include "dual/pillows/pillow.h"

namespace hexwright::dual {

class PillowStack {
 public:
  /// `complex` holds the base mesh; `split` has its core planes chosen.
  PillowStack(HexComplex& complex, const Domain& domain, const std::vector<SplitNodes>& split);

  void run(const Context& context);

 private:
  // A lattice hex in a closed split node of the current depth.
  struct ActiveHex {
    HexId hex;
    std::uint8_t parity;  // of the node's core planes
  };

  void activate_depth(int depth);
  void wrap_axis(int axis);
  bool is_on_core_plane(const ActiveHex& h, int axis) const;
  bool is_on_plane(const LatticeCoord& p, int axis, int parity) const;
  std::uint8_t parity_of(std::int32_t group) const;
  bool is_core_point(const LatticeCoord& p, int axis) const;
  HexPlace place_layer_hex(HexId inner, HexId outer, int axis) const;
  HexPlace place_bent(HexId inner, HexId outer, int axis, int differing) const;
  std::int32_t group_around(const LatticeCoord& p) const;

  HexComplex& complex_;
  const Domain& domain_;
  const std::vector<SplitNodes>& split_;
  PillowInserter inserter_;
  std::vector<ActiveHex> active_;
  std::vector<HexId> core_;
  int depth_ = 0;
  std::int32_t spacing_ = 0;  // of the lattice of depth_, in finest units
};

}  // namespace hexwright::dual
