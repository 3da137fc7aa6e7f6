// A hex mesh of second order: mid-nodes of edges on the surface, valid by proof.
//
// Based on: Johnen, Remacle, Geuzaine, "Geometrical validity of curvilinear finite elements",
// Journal of Computational Physics 233, 2013 (the proof, by Bezier coefficients and subdivision).
#pragma once

#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/exact_shape.h"
#include "hexwright/geometry/side.h"
#include "hexwright/geometry/surface_parts.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/target/target.h"

namespace hexwright {

/// An edge whose mid-node is not on the surface, because an element beside it would break.
struct HeldBackEdge {
  Vec3 position;        ///< of the mid-node, in the mesh's coordinates
  double share = 0;     ///< of the way from the chord to the surface that it goes
  double distance = 0;  ///< that is left to the surface

  void to_world(const Similarity& frame) {
    position = frame.to_world(position);
    distance = frame.length_to_world(distance);
  }
};

struct CurvingReport {
  std::size_t num_edges = 0;            ///< of the mesh
  std::size_t num_surface_edges = 0;    ///< that stand for the surface or its curves
  std::size_t num_curved = 0;           ///< whose mid-node is off the chord
  std::size_t num_unmatched = 0;        ///< no surface near: straight
  double max_offset = 0;                ///< greatest distance of a mid-node from its chord
  std::vector<HeldBackEdge> held_back;  ///< farthest from the surface first

  void to_world(const Similarity& frame);
};

/// What a mesh is curved to.
struct CurvingTarget {
  const SurfaceTree& tree;
  const SurfaceParts& parts;  ///< under the numbers of the mesh's labels
  Side side = Side::Inside;   ///< of the surface that the mesh is on
  /// What the surface stands for, in its own coordinates, to which `frame` leads from the mesh's:
  /// mid-nodes are put onto it. May be null.
  const ExactShape* exact = nullptr;
  Similarity frame = {};
};

/// Gives the mesh mid-nodes: of edges on labelled curves on these, of other edges of labelled quads
/// on their patch, of all others on the chord. Where the Jacobian of an element would not be proven
/// to stay above a tenth of the least at its corners, mid-nodes go back towards their chords, those
/// that help most first. Vertices stay. Same result for any thread count.
///
/// Guarantee: an element that is proven valid with straight edges is proven valid with curved ones.
CurvingReport curve_mesh(HexMesh& mesh, const CurvingTarget& target, const Context& context);

}  // namespace hexwright
