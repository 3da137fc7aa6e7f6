#include "relax/passes/pass.h"

#include <algorithm>

#include "hexwright/base/assert.h"

#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

void sweep_once(const Pass& pass, const LocalSweep& local, SweepOptions sweep, Body& body) {
  IdVector<HexId, double> weight;
  if (pass.weigh) {
    weight = pass.weigh(body.mesh);
    sweep.hex_weight = &weight;
  }
  if (pass.again == Again::All)
    local.run(body, sweep);
  else
    local.run_dirty(body, sweep);
}

// One round's sweeps on a region. `refresh()` is called before those at each weight.
template <class Refresh>
void run_weights(const Pass& pass, const LocalSweep& local, SweepOptions sweep, Body& body,
                 const Context& context, const Refresh& refresh) {
  sweep.marks_neighbors = pass.again != Again::Moving;
  for (double weight : pass.weights) {
    context.check_cancelled();
    refresh();
    sweep.weight = weight;
    for (int s = 0; s < pass.sweeps; ++s) sweep_once(pass, local, sweep, body);
  }
}

/// The rounds of a pass. `find_bad()`: one entry per vertex, or nothing; `refresh(round, region)`
/// is called before the sweeps at each weight.
template <class FindBad, class Refresh>
bool run_rounds(const Pass& pass, Body& body, const Context& context, const FindBad& find_bad,
                const Refresh& refresh) {
  SweepOptions sweep = pass.sweep;
  sweep.untangle_share = pass.untangle.first;
  for (int round = 0; round < pass.max_rounds; ++round) {
    context.check_cancelled();
    std::vector<char> region = find_bad();
    if (region.empty()) return true;
    grow_vert_set(body, region,
                  pass.rings + (pass.rounds_per_ring > 0 ? round / pass.rounds_per_ring : 0));
    const LocalSweep local(body, region);
    if (pass.again != Again::All)
      for (VertId v : body.is_dirty.ids())
        if (region[v.index()]) body.is_dirty[v] = 1;
    run_weights(pass, local, sweep, body, context, [&] { refresh(round, region); });
    sweep.untangle_share = std::max(pass.untangle.ratio * sweep.untangle_share, pass.untangle.last);
  }
  return false;
}

std::vector<char> find_stuck(const FitState& state, double limit) {
  std::vector<char> region;
  for (VertId v : state.kind.ids()) {
    if (state.stars[v].empty() || !(state.residual(v) > limit)) continue;
    if (region.empty()) region.assign(state.num_verts(), 0);
    region[v.index()] = 1;
  }
  return region;
}

// A new attachment weight moves the boundary; the inside follows where it moved.
void mark_boundary_dirty(FitState& state, const std::vector<char>& region) {
  for (VertId v : state.kind.ids())
    if (region[v.index()] && state.is_boundary(v)) state.is_dirty[v] = 1;
}

}  // namespace

bool run(const Pass& pass, Body& body, const Context& context) {
  HEXWRIGHT_ASSERT(pass.bad == Bad::Hexes);
  return run_rounds(
      pass, body, context, [&] { return verts_of_poor_hexes(body, pass.limit); },
      [](int, const std::vector<char>&) {});
}

bool run(const Pass& pass, FitState& state, const FitTarget& target, const Context& context) {
  const auto find_bad = [&] {
    if (pass.bad == Bad::Hexes) return verts_of_poor_hexes(state, pass.limit);
    update_targets(state, target, 0);
    return find_stuck(state, pass.limit);
  };
  return run_rounds(pass, state, context, find_bad,
                    [&](int round, const std::vector<char>& region) {
                      if (round > 0 || pass.bad == Bad::Verts)
                        update_targets(state, target, 0, region);
                      if (pass.again == Again::Dirty) mark_boundary_dirty(state, region);
                    });
}

void run_on(const std::vector<char>& region, const Pass& pass, FitState& state,
            const FitTarget& target, const Context& context) {
  SweepOptions sweep = pass.sweep;
  sweep.untangle_share = pass.untangle.first;
  run_weights(pass, LocalSweep(state, region), sweep, state, context, [&] {
    update_targets(state, target, 0, region);
    if (pass.again == Again::Dirty) mark_boundary_dirty(state, region);
  });
}

}  // namespace hexwright::relax
