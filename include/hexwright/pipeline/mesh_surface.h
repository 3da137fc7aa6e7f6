// The main job: surface in, verified all-hex mesh out.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/fit.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/grid/complete.h"
#include "hexwright/grid/sizing.h"
#include "hexwright/quality/judge.h"

namespace hexwright {

struct MeshOptions {
  SizingOptions sizing;
  CompleteOptions complete;
  DualOptions dual;  ///< mode follows complete.pairing
  FitOptions fit;
  JudgeOptions judge;
  int max_rounds = 6;                 ///< refine where the fit missed; 0 = a single pass
  std::size_t max_hexes = 2'000'000;  ///< budget of the background mesh
};

/// Seconds and counts of one stage of the best round.
struct StageRecord {
  std::string name;
  double seconds = 0;
  std::map<std::string, double> counts;
};

struct MeshResult {
  HexMesh mesh;
  Verdict verdict;
  SurfaceDiagnosis surface;
  Grid grid;  ///< the completed grid of the best round
  FitReport fit;
  std::vector<StageRecord> stages;
  int num_rounds = 0, best_round = 0;
  std::vector<std::string> warnings;
  std::vector<std::string> failures;  ///< why the mesh misses the gate; empty = done and valid
};

/// Errors: those of prepare_surface; OutOfResources when the budgets leave no mesh.
MeshResult mesh_surface(const TriMesh& surface, const MeshOptions& options, const Context& context);

}  // namespace hexwright
