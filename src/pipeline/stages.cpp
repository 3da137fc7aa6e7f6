// Stages run alone.
#include "hexwright/pipeline/stages.h"

#include <optional>

#include "hexwright/base/error.h"
#include "hexwright/pipeline/plan.h"

namespace hexwright {

SizingResult size_surface(const TriMesh& surface, const MeshOptions& options,
                          const Context& context) {
  MeshOptions as_given = options;
  as_given.target.placement = Placement::AsGiven;  // grids have no axes of their own
  const Target target = make_target(surface, plan_target(as_given), context);
  SizingResult result = build_grid(target, plan(as_given, target).sizing, context);
  result.to_world(target.frame);
  return result;
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

void FitStageResult::to_world(const Similarity& frame) {
  fit.to_world(frame);
  if (curving) curving->to_world(frame);
}

FitStageResult run_fit_stage(const HexMesh& background, const Target& target,
                             const FitStageOptions& options, const Context& context) {
  FitOptions wishes = options.fit;
  if (options.order == 2) wishes.patch_verts = PatchVerts::OnSurface;
  FitStageResult result{fit(background, target, wishes, context), {}};
  if (options.order == 2 && result.fit.parts)
    result.curving =
        curve_mesh(result.fit.mesh, {target.tree, *result.fit.parts, wishes.carve.side}, context);
  return result;
}

}  // namespace hexwright
