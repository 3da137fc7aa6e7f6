// Far-field expansion of the winding number for every child of a hierarchy.
//
// Based on: Barill et al., "Fast Winding Numbers for Soups and Clouds", ACM TOG 37(4), 2018,
// section 3 (dipole and first-order term, exact for plane triangles).
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"
#include "geometry/triangle_math.h"

namespace hexwright {

/// For child k of a node: all its triangles as one dipole at their area-weighted centre.
struct WindingNode {
  double center[3][4];
  double normal[3][4];  ///< sum of area normals
  double moment[6]
               [4];  ///< sum of area normal x (centroid - centre), symmetrised: xx yy zz xy yz zx
  double radius_sq[4];  ///< of the ball about the centre that holds all corners
};

/// One per node of the hierarchy. `slots` are the triangles in leaf order.
std::vector<WindingNode> compute_winding_nodes(const TriangleBvh& bvh,
                                               const std::vector<TriangleData>& slots);

/// Winding number at p; children farther than `accuracy` radii count as expansions.
double evaluate_winding(const TriangleBvh& bvh, const std::vector<WindingNode>& nodes,
                        const std::vector<TriangleData>& slots, const Vec3& p, double accuracy);

}  // namespace hexwright
