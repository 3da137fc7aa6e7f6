// Stages run alone.
#include "hexwright/pipeline/stages.h"

#include <optional>

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

namespace {

/// Blocks are made with weak balance at least; sheets with that or the relaxed one, which do not
/// imply each other.
std::optional<Issue> find_unbalanced_for(DualMode mode, const Grid& grid) {
  auto issue = find_unbalanced(grid, Balance::Weak);
  return issue && mode == DualMode::Sheets ? find_unbalanced(grid, Balance::Relaxed) : issue;
}

}  // namespace

DualMode resolve_dual_mode(const Grid& grid, const DualStageOptions& options) {
  if (options.mode) return *options.mode;
  return find_unpaired(grid) ? DualMode::Sheets : DualMode::Blocks;
}

DualResult run_dual_stage(const Grid& grid, const DualStageOptions& options,
                          const Context& context) {
  DualOptions dual;
  dual.mode = resolve_dual_mode(grid, options);
  dual.optimize = options.optimize;
  if (const auto issue = find_unbalanced_for(dual.mode, grid))
    throw Error(ErrorCode::BadGeometry,
                issue->message + "; run 'hexwright complete' on the grid first");
  return build_dual(grid, dual, context);
}

Verdict judge_polycube(const PolycubeResult& result, const Context& context) {
  JudgeOptions options;
  options.features.crease_angle = 4;  // radians: more than any edge turns
  return judge(result.mesh, SurfaceTree(result.surface), options, context);
}

}  // namespace hexwright
