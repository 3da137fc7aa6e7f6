// Stages run alone.
#include "hexwright/pipeline/stages.h"

#include "hexwright/base/error.h"

namespace hexwright {

SizingResult size_surface(const TriMesh& surface, const MeshOptions& options,
                          const Context& context) {
  const PreparedSurface prepared = prepare_surface(surface, context);
  const double diagonal = bounding_box(prepared.mesh).diagonal();
  const FeatureGraph features =
      extract_features(prepared.mesh, features_for_sizing(options.fit.features, diagonal));
  return build_grid(prepared.mesh, features, options.sizing, context);
}

DualMode resolve_dual_mode(const Grid& grid, const DualStageOptions& options) {
  if (options.mode) return *options.mode;
  return find_unpaired(grid) ? DualMode::Sheets : DualMode::Blocks;
}

DualResult run_dual_stage(const Grid& grid, const DualStageOptions& options,
                          const Context& context) {
  DualOptions dual;
  dual.mode = resolve_dual_mode(grid, options);
  dual.optimize = options.optimize;
  const Balance needed = dual.mode == DualMode::Sheets ? Balance::Relaxed : Balance::Weak;
  if (const auto issue = find_unbalanced(grid, needed))
    throw Error(ErrorCode::BadGeometry,
                issue->message + "; complete the grid first (hexwright complete)");
  return build_dual(grid, dual, context);
}

Verdict judge_polycube(const PolycubeResult& result, const Context& context) {
  JudgeOptions options;
  options.features.crease_angle = 4;  // radians: more than any edge turns
  return judge(result.mesh, SurfaceTree(result.surface), options, context);
}

}  // namespace hexwright
