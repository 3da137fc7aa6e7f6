// What each stage is asked for: the wishes of a run, put in terms of the surface at hand.
#pragma once

#include <limits>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// Where the loop ends though something is missed. Counts, not seconds, so that results do not
/// depend on the machine.
struct Budgets {
  std::size_t background = std::numeric_limits<std::size_t>::max();  ///< hexes of one background
  /// Cells of a grid that keeps to the sizes asked for: more would leave too many hexes.
  std::size_t sized = std::numeric_limits<std::size_t>::max();
  std::size_t rounds = std::numeric_limits<std::size_t>::max();  ///< of all rounds' backgrounds
  /// Cells of the next grid over those of the last, from a valid mesh within the gate.
  double growth = std::numeric_limits<double>::infinity();
  bool is_shortened = false;  ///< for an open or overlapping surface: rounds are a share of theirs
};

/// Options of the stages as they run, in the target's coordinates.
struct StagePlan {
  SizingOptions sizing;
  SizeField sizes;
  CompleteOptions complete;
  EvenOptions even;
  DualOptions dual;
  FitOptions fit;
  JudgeOptions judge;
  Budgets budgets;
};

/// Pure: the same wishes and target give the same plan. Errors: BadArgument when wishes about sizes
/// do not fit the target.
StagePlan plan(const MeshOptions& wishes, const Target& target, const Context& context = {});

/// What a mesh is judged by; also that of a surface whose bodies were meshed apart.
JudgeOptions plan_judge(const MeshOptions& wishes);

/// What a target is asked for. With the background meshed as well it stays as given, because the
/// box around it would turn.
TargetOptions plan_target(const MeshOptions& wishes);

}  // namespace hexwright
