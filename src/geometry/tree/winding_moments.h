// Far-field expansion of the winding number for every child of a hierarchy.
//
// Based on: Barill et al., "Fast Winding Numbers for Soups and Clouds", ACM TOG 37(4), 2018,
// section 3 (dipole and first-order term, exact for plane triangles).
#pragma once

#include <vector>

#include "geometry/tree/triangle_bvh.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright {

/// For each child of a node: all its triangles as one dipole at their area-weighted centre.
/// Children 0 and 1 are the first pair, 2 and 3 the second. An unused child repeats the centre and
/// radius of another, without moments.
struct WindingNode {
  struct Pair {
    Double2 center[3];
    Double2 normal[3];  ///< sum of area normals
    Double2 moment[6];  ///< area normal x (centroid - centre): xx yy zz xy+yx yz+zy zx+xz
    Double2 radius_sq;  ///< of the ball about the centre that holds all corners
  };
  Pair pair[2];
};

/// One per node of the hierarchy. `slots` are the triangles in leaf order.
std::vector<WindingNode> compute_winding_nodes(const TriangleBvh& bvh,
                                               const std::vector<TriangleData>& slots);

/// Winding number at p; children farther than `accuracy` radii count as expansions.
double evaluate_winding(const TriangleBvh& bvh, const std::vector<WindingNode>& nodes,
                        const std::vector<TriangleData>& slots, const Vec3& p, double accuracy);

}  // namespace hexwright
