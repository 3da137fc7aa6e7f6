// The judge: everything `hexwright check` says about a hex mesh, with or without its surface.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/surface_topology.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"
#include "hexwright/quality/surface_distance.h"
#include "hexwright/target/target.h"

namespace hexwright {

/// How much of one feature curve the mesh's edges represent.
struct CurveRecovery {
  double length = 0;  ///< in the mesh's coordinates
  double turn = 0;    ///< sum of the angles between its segments, radians
  double length_share = 1;

  void to_world(const Similarity& frame) { length = frame.length_to_world(length); }
};

/// A place on the surface's features that the mesh does not represent, in the mesh's coordinates.
struct MissedFeature {
  Vec3 position;
  CurveId curve;        ///< of FeatureRecovery::curves; invalid: a corner
  double distance = 0;  ///< of a corner to the nearest boundary vertex; 0 on a curve

  void to_world(const Similarity& frame) {
    position = frame.to_world(position);
    distance = frame.length_to_world(distance);
  }
};

/// How much of the surface's sharp features the mesh's edges and vertices represent.
struct FeatureRecovery {
  double total_length = 0;  ///< of the surface's feature curves, world units
  /// Share of it within edge_tolerance of a boundary edge of the mesh that runs along it, that is
  /// at no more than 30 degrees.
  double length_share = 1;
  IdVector<CurveId, CurveRecovery> curves;  ///< the same of each curve
  std::size_t num_corners = 0;
  std::size_t num_corners_recovered =
      0;  ///< within corner_tolerance of a mesh vertex on the boundary
  /// Points every edge_tolerance along the length that is not represented, and then the corners
  /// that are not recovered.
  std::vector<MissedFeature> missed;

  void to_world(const Similarity& frame);
};

/// Shares are of the surface's diagonal.
struct JudgeOptions {
  /// What stands for the surface, and whose edges and vertices may be features.
  JudgedQuads quads = JudgedQuads::Boundary;
  double edge_tolerance = 0.001;
  double corner_tolerance = 0.0005;
  double spacing = DistanceOptions{}.spacing;  ///< of the samples that distances are measured at
  double hot_threshold = 0;  ///< samples farther than this become SurfaceDistance::hot; 0 = none
  /// What the mesh fills, in its coordinates: what lies on its sides or beyond is no surface to be
  /// near to.
  std::optional<Box3> domain = {};
  double bound_gap = 0;  ///< of the largest distance's upper bound (DistanceOptions); 0 = none
};

/// Features of the surface that the mesh represents. Samples the curves every edge_tolerance.
FeatureRecovery measure_features(const HexMesh& mesh, const SurfaceTree& surface,
                                 const FeatureGraph& features, const JudgeOptions& options);

struct Verdict {
  TopologyReport topology;
  QualitySummary quality;                          ///< by the corners
  std::optional<SecondOrderQuality> second_order;  ///< of a mesh with mid-nodes
  std::optional<SurfaceDistance> distance;         ///< with a surface only
  std::optional<FeatureRecovery> features;
  /// By how much of the volume within the surface the mesh has more, or less when negative: where
  /// the surface is closed, manifold and oriented, and the mesh's whole boundary stands for it.
  std::optional<double> volume_error;
  std::optional<SurfaceTopology> surface;  ///< to compare the mesh's components and genus with
  /// Components or genus of the boundary are not the surface's, though it stands for all of it.
  bool has_other_topology = false;
  std::vector<std::string>
      failures;  ///< why it is not valid, one sentence each; warnings are not here
  std::vector<std::string> warnings;
  bool is_valid() const { return failures.empty(); }
  /// Maps lengths, places and volumes; the sentences hold none but shares.
  void to_world(const Similarity& frame);
};

/// Valid = at least one hex, topology valid and no inverted hex. Distance, features, components and
/// genus are reported, with warnings, not judged. Throws Error{BadArgument} when an index of the
/// mesh is out of range or a coordinate is not finite.
Verdict judge(const HexMesh& mesh, const JudgeOptions& options, const Context& context);
/// Against a target, in its coordinates.
Verdict judge(const HexMesh& mesh, const Target& target, const JudgeOptions& options,
              const Context& context);
/// One-shot: the surface in any units, the mesh and the verdict in the same.
Verdict judge(const HexMesh& mesh, const TriMesh& surface, const TargetOptions& target,
              const JudgeOptions& options, const Context& context);

}  // namespace hexwright
