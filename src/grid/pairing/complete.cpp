// Completion's driver: grid -> nested sets -> one sweep from the deepest depth to the roots ->
// grid.
//
// Based on: Pitzalis et al. 2021, sections 3-5, as docs/algorithms/pairing.md restates them.
// Differs: one integer-free labelling problem per depth; no re-balancing between depths.
#include "hexwright/grid/complete.h"

#include "hexwright/base/assert.h"

#include "grid/pairing/balance.h"
#include "grid/pairing/block_sweep.h"
#include "grid/pairing/descent.h"
#include "grid/sets/nested_sets.h"
#include "grid/sets/pose.h"

namespace hexwright {

using namespace grids;

namespace {

/// One pass from the deepest depth to the roots; nothing iterates, as what a depth requires of the
/// one above is known once its own set is final.
NestedSets balance_only(const NestedSets& input, Balance balance, const LatticeDomain& domain) {
  NestedSets out = input;
  for (int d = static_cast<int>(out.size()) - 2; d >= 0; --d) {
    out[d] = required_above(out[d + 1], d + 1, balance, domain, input[d]);
    if (balance == Balance::Relaxed && d + 2 < static_cast<int>(out.size()))
      out[d] = required_two_above(out[d + 2], d + 2, domain, out[d]);
  }
  return out;
}

/// The prior art: every block a sibling octet. No choice is left, so the result is unique.
NestedSets pair_octets(const NestedSets& input, Balance balance, const LatticeDomain& domain) {
  NestedSets out(input.size());
  for (int d = static_cast<int>(input.size()) - 1; d >= 0; --d) {
    const BrickSet required = d + 1 < static_cast<int>(input.size())
                                  ? required_above(out[d + 1], d + 1, balance, domain, input[d])
                                  : input[d];
    out[d] = blocks_of_parity(required, kOctreeParity, d, domain);
  }
  return out;
}

/// Each depth takes the labels that are cheapest there, whatever they force above.
NestedSets sweep_blocks(const BlockSweep& sweep, const Context& context, CompleteReport& report) {
  NestedSets out(sweep.input().size());
  BrickSet split;
  for (int d = sweep.num_depths() - 1; d >= 0; --d) {
    context.check_cancelled();
    const DepthProblem problem = sweep.pose(sweep.required(d, split), d);
    count_problem(problem, report);
    out[d] = split = sweep.split(problem, problem.solution.labels, d);
    context.progress("complete", 1 - static_cast<double>(d) / sweep.num_depths());
  }
  return out;
}

std::size_t count_nodes(const NestedSets& sets) {
  std::size_t total = 0;
  for (const BrickSet& set : sets) total += set.num_nodes();
  return total;
}

NestedSets choose_blocks(const NestedSets& input, const CompleteOptions& options,
                         const LatticeDomain& domain, const Context& context,
                         CompleteReport& report) {
  const BlockSweep sweep(input, options.balance, domain);
  return options.improve ? Descent(sweep, context).run(report)
                         : sweep_blocks(sweep, context, report);
}

/// As choose_blocks(), in the pose that goes with the grid's shape, because ties are broken by
/// position.
NestedSets choose_blocks_posed(const NestedSets& input, const CompleteOptions& options,
                               const LatticeDomain& domain, const Context& context,
                               CompleteReport& report) {
  const Pose pose = choose_pose(input, domain);
  if (is_identity(pose)) return choose_blocks(input, options, domain, context, report);
  const int num_depths = static_cast<int>(input.size());
  const PosedDomain posed(domain, pose, num_depths);
  NestedSets sets;
  for (int d = 0; d < num_depths; ++d) sets.push_back(posed.to_posed(input[d], d));
  sets = choose_blocks(sets, options, posed.domain(), context, report);
  for (int d = 0; d < num_depths; ++d) sets[d] = posed.to_original(sets[d], d);
  return sets;
}

NestedSets pair_blocks(const NestedSets& input, const CompleteOptions& options,
                       const LatticeDomain& domain, const Context& context,
                       CompleteReport& report) {
  NestedSets out = choose_blocks_posed(input, options, domain, context, report);
  // Cheapest depth by depth need not be cheapest in all: sibling octets are blocks too.
  NestedSets octets = pair_octets(input, options.balance, domain);
  return count_nodes(octets) < count_nodes(out) ? std::move(octets) : std::move(out);
}

NestedSets complete_sets(const NestedSets& input, const CompleteOptions& options,
                         const LatticeDomain& domain, const Context& context,
                         CompleteReport& report) {
  context.check_cancelled();
  switch (options.pairing) {
    case Pairing::None:
    case Pairing::Sheets:
      return balance_only(input, options.balance, domain);
    case Pairing::Octree:
      return pair_octets(input, options.balance, domain);
    case Pairing::Blocks:
      break;
  }
  return pair_blocks(input, options, domain, context, report);
}

}  // namespace

CompleteResult complete(const Grid& grid, const CompleteOptions& asked, const Context& context) {
  const auto watch = context.watch();
  CompleteOptions options = asked;
  options.balance = resolve_balance(asked);
  if (const auto issue = grid.find_problem())
    throw Error(ErrorCode::BadArgument, "complete: " + issue->message);
  const bool needs_blocks =
      options.pairing == Pairing::Blocks || options.pairing == Pairing::Octree;
  if (options.balance == Balance::Relaxed && needs_blocks)
    throw Error(ErrorCode::BadArgument,
                "complete: relaxed balance goes with pairing sheets or none; blocks need weak "
                "or strong balance");
  const LatticeDomain domain(grid.roots, grid.finest_level);
  CompleteResult result;
  CompleteReport& report = result.report;
  const NestedSets input = split_sets_of(grid, domain);
  const NestedSets output = complete_sets(input, options, domain, context, report);
  for (const BrickSet& set : input) report.num_split_input.push_back(set.num_nodes());
  for (const BrickSet& set : output) report.num_split_output.push_back(set.num_nodes());
  result.grid = grid_of(output, grid, domain);
  report.num_input_cells = grid.num_cells();
  report.num_output_cells = result.grid.num_cells();
  return result;
}

}  // namespace hexwright
