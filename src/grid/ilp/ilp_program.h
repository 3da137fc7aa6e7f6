// The integer programs of block pairing: one depth, or the whole hierarchy.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "hexwright/grid/complete.h"

#include "grid/ilp/ilp_model.h"
#include "grid/sets/nested_sets.h"

namespace hexwright::grids {

/// Least number of nodes in a conflict-free set of blocks that covers `required`: the paper's
/// program, with a variable for every vertex that touches a node of `nodes` (a superset of
/// `required`) and all 308 exclusions per vertex.
IlpSolution solve_depth_program(const BrickSet& required, const BrickSet& nodes, int depth,
                                const LatticeDomain& domain, double time_limit_seconds,
                                BrickSet* split);

/// Least total number of split nodes over all depths. `start`: a completed hierarchy, or empty.
IlpSolution solve_hierarchy_program(const NestedSets& input, const NestedSets& start,
                                    Balance balance, const LatticeDomain& domain,
                                    double time_limit_seconds, NestedSets* split);

}  // namespace hexwright::grids
