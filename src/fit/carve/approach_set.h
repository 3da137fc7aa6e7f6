// Moves a set of hexes towards another threshold of the filling without changing its topology.
#pragma once

#include "fit/carve/carve_classify.h"
#include "fit/carve/set_check.h"

namespace hexwright::fitting {

/// What a set of a background mesh's hexes is judged by. The members must outlive it.
struct SetScene {
  const HexMesh& mesh;
  const VertToHex& vert_to_hex;
  const HexNeighbors& neighbors;
  const HexFilling& filling;
  double visible;  ///< least cosine of SetCheck::check
};

/// Flips hexes whose membership differs from `fraction > threshold`, the worst represented first,
/// as long as the set stays manifold and visible (SetCheck) and is deformed only: no flip joins,
/// separates, pierces or plugs anything. Parts and gaps that are one hex thick are left alone, for
/// peeling them from their rim would undo them as a hole would.
///
/// Requires: the set passes SetCheck at every vertex. Deterministic. Returns the number of flips.
///
/// Based on: homotopic thinning by simple points (Kong, Rosenfeld, "Digital topology", Computer
/// Vision, Graphics, and Image Processing 48, 1989). Differs: on unstructured hexes, where the
/// vertices' checks stand for the neighbourhood's.
std::size_t approach_threshold(const SetScene& scene, double threshold, std::vector<char>& in_set);

}  // namespace hexwright::fitting
