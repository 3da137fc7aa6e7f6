// Improves a hex mesh's shape without changing its connectivity, never inverting an element.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/target/target.h"

namespace hexwright {

struct ImproveOptions {
  int max_rounds = 20;
  double goal = 1.0;  ///< stop when the least scaled Jacobian reaches this
  /// Boundary vertices slide on its surface; null keeps them fixed. The mesh lies in the target's
  /// world; it is worked on in unit coordinates, as in every other stage.
  const Target* slide_on = nullptr;
};

struct ImproveReport {
  double min_before = 0, min_after = 0, avg_before = 0, avg_after = 0;
  HexId worst_hex;
  /// No placement of the vertices that may move gives a larger least scaled Jacobian than this:
  /// what the held boundary allows. When min_after reaches it, the mesh cannot be improved.
  double upper_bound = 1;
  HexId bounding_hex;           ///< where the held boundary sets that bound
  bool worst_is_fixed = false;  ///< all vertices of the worst corner are held by the fixed boundary
};

/// A surface of any size to slide on: in unit coordinates, with nothing cleaned or turned. Holds
/// its frame and tree, which is all that improve() asks for; features and topology are not derived.
Target make_slide_target(const TriMesh& surface);

/// Starts from any mesh; inverted elements are untangled first where that is possible.
ImproveReport improve(HexMesh& mesh, const ImproveOptions& options, const Context& context);

}  // namespace hexwright
