// Pillow insertion: wraps one layer of hexes around a set of hexes.
//
// Based on: Mitchell, Tautges, "Pillowing doublets", 4th International Meshing Roundtable, 1995.
// Differs: the layer is found and linked through face neighbours alone, and ends flat on the
// domain's boundary.
#pragma once

#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "dual/complex/hex_complex.h"

namespace hexwright::dual {

/// Keeps its scratch memory between pillows; each one costs time linear in the set it wraps.
class PillowInserter {
 public:
  explicit PillowInserter(HexComplex& complex) : complex_(complex) {}

  /// Inserts the layer between the hexes of `inside` (no repetitions) and their neighbours not in
  /// it. Returns the first new hex; the others follow. Of each new hex, face -z (4) lies on its
  /// inner hex and face +z (5) on its outer one. Places are left for the caller to fill.
  /// Requires: around any mesh edge with four interface faces, the inner hexes are not joined by
  /// faces at both of its ends.
  HexId insert(std::span<const HexId> inside);

 private:
  // A face of an inner hex towards an outer one; the k-th vertex of the inner hex's face is vertex
  // outer_vert[k] of the outer hex.
  struct InterfaceFace {
    HexId inner, outer;
    std::int8_t inner_lf, outer_lf;
    std::array<std::int8_t, 4> outer_vert;
  };
  struct Corner {
    HexId hex;
    int lv;
  };
  struct CornerChange {
    HexId hex;
    int lv;
    VertId vert;
  };

  bool is_inside(HexId h) const { return is_inside_[h.index()] != 0; }
  void collect_interface(std::span<const HexId> inside);
  void split_verts();
  void split_vert(VertId v, HexId start);
  void gather_star(VertId v, HexId start);
  void join_outer_across_edges();
  void link_layer();
  void link_side(HexId layer_hex, const InterfaceFace& face, int k);

  HexComplex& complex_;
  HexId first_layer_hex_;
  std::vector<char> is_inside_;     // per hex
  std::vector<std::int32_t> slot_;  // per hex: index in star_, trusted only if star_ confirms it
  std::vector<char> is_vert_done_;  // per vertex
  std::vector<VertId> done_verts_;
  std::vector<InterfaceFace> interface_;
  std::vector<Corner> star_;
  BasicDisjointSets<int> parts_{0};  // of the star
  std::vector<CornerChange> changes_;
};

}  // namespace hexwright::dual
