// Foldover-free optimisation of a tetrahedral map.
//
// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/mesh/tet_mesh.h"

namespace hexwright::polycube {

/// Vertices that have one coordinate along an axis in common, as those of a face of a polycube.
struct Tie {
  int axis = 0;
  std::vector<VertId> verts;
};

struct UnfoldOptions {
  /// Their vertices move along their axis together. Ties of one axis share no vertex.
  std::span<const Tie> ties;
  /// The shape a tet strives for, where it is not the object's: the same for a tet of any place.
  std::function<std::array<Vec3, 4>(TetId)> reference;
  /// One descent more once all tets are positive, towards even shapes and volumes.
  bool polishes = false;
};

/// Moves vertices of `image` along their free axes (bit a of `free_axes`: axis a; 0 = fixed) until
/// every tet that has a free vertex is positive, or nothing more is gained; tets strive for the
/// shape they have in `object`. Requires equal connectivity and positive volume of `object`'s tets
/// (others are only kept positive), and that tied vertices are free along the tie's axis and start
/// with equal coordinates. Returns the number of such tets that are not positive. The same result
/// for any number of threads.
std::size_t unfold(const TetMesh& object, const IdVector<VertId, std::uint8_t>& free_axes,
                   TetMesh& image, const UnfoldOptions& options, const Context& context);
inline std::size_t unfold(const TetMesh& object, const IdVector<VertId, std::uint8_t>& free_axes,
                          TetMesh& image, const Context& context) {
  return unfold(object, free_axes, image, {}, context);
}

}  // namespace hexwright::polycube
