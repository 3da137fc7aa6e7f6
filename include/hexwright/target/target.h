// The surface that is meshed, with everything that is known of it: derived once, and handed to the
// sizing, the fit and the judge.
#pragma once

#include <array>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/base/stage_record.h"
#include "hexwright/geometry/expected_topology.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_topology.h"
#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// How the lattice lies on the part.
enum class Placement {
  Faces,   ///< along the dominant orthogonal frame of its faces (see geometry/pose.h)
  AsGiven  ///< along the axes of its coordinates
};

/// What is wished of a target.
struct TargetOptions {
  Placement placement = Placement::AsGiven;
  /// In the surface's own coordinates. A `min_length` of 0 stands for 3% of the diagonal: short
  /// loose creases are noise of scanned and decimated surfaces, and grids sized by them would be
  /// refined to the deepest level everywhere.
  FeatureOptions features;
  PrepareOptions prepare;  ///< shares of the diagonal
};

/// Everything is in unit coordinates, in which the surface's longest side is between 1 and 2;
/// `frame` leads from there to the world. Const once made.
struct Target {
  Similarity frame;
  /// Of the triangles, which are tree.surface(): welded, clean, oriented, placed. Its diagonal is
  /// that of the surface as given.
  SurfaceTree tree;
  FeatureOptions feature_options = {};              ///< what `features` were extracted by
  std::vector<std::array<VertId, 2>> creases = {};  ///< by angle; for features by other lengths
  FeatureGraph features = {};
  SurfaceTopology topology = {};
  ExpectedTopology expected = {};
  SurfaceDiagnosis diagnosis = {};
  std::vector<StageRecord> stages = {};  ///< what deriving it took

  const TriMesh& surface() const { return tree.surface(); }
  double diagonal() const { return tree.diagonal(); }
};

/// Prepares a surface, places it in the unit frame and finds its features. Lengths of the options
/// are in the surface's own coordinates. Warns of feature edges that are no edges of the surface.
/// Same result for any thread count. Errors: those of prepare_surface.
Target make_target(const TriMesh& surface, const TargetOptions& options, const Context& context);

/// The target of a surface that is sound and about unit size: nothing is cleaned, scaled or turned,
/// and triangles keep their ids. Lengths of the options count as they are; `frame` is that in which
/// the surface stands already.
Target wrap_target(TriMesh surface, const FeatureOptions& features = {},
                   const Similarity& frame = {});

}  // namespace hexwright
