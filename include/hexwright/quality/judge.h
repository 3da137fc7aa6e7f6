// The judge: everything `hexwright check` says about a hex mesh, with or without its surface.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"
#include "hexwright/quality/surface_distance.h"

namespace hexwright {

/// How much of the surface's sharp features the mesh's edges and vertices represent.
struct FeatureRecovery {
  double total_length = 0;  ///< of the surface's feature curves, world units
  double length_share = 1;  ///< share of it within edge_tolerance of a mesh edge that runs along it
  std::size_t num_corners = 0;
  std::size_t num_corners_recovered =
      0;  ///< within corner_tolerance of a mesh vertex on the boundary
};

struct JudgeOptions {
  FeatureOptions features;
  double edge_tolerance = 0.001;     ///< share of the diagonal
  double corner_tolerance = 0.0005;  ///< share of the diagonal
  DistanceOptions distance;
};

struct Verdict {
  TopologyReport topology;
  QualitySummary quality;
  std::optional<SurfaceDistance> distance;  ///< with a surface only
  std::optional<FeatureRecovery> features;
  std::vector<std::string>
      failures;  ///< why it is not valid, one sentence each; warnings are not here
  std::vector<std::string> warnings;
  bool is_valid() const { return failures.empty(); }
};

/// Valid = topology valid and no inverted hex. Distance and features are reported, not judged.
Verdict judge(const HexMesh& mesh, const JudgeOptions& options, const Context& context);
Verdict judge(const HexMesh& mesh, const SurfaceTree& surface, const JudgeOptions& options,
              const Context& context);

}  // namespace hexwright
