// Descent over cluster labels with the true cost over all depths.
#include "grid/pairing/descent.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "grid/pairing/cluster_requirements.h"
#include "grid/sets/hash.h"

namespace hexwright::grids {
namespace {

// Work allowed beyond the sweep's own, counted in bricks, not in seconds, so that results do not
// depend on the machine: twice the sweep's, and for small grids what takes some milliseconds. Past
// kSmallSweep bricks (some 30,000 cells) the latter falls as the inverse of the size, so that from
// 10^5 cells on the descent stays within three times the sweep's time.
constexpr std::size_t kWorkFactor = 2;
constexpr std::size_t kSmallGridWork = 60'000, kSmallSweep = 250;

// Problems up to this many bricks take the costs of clusters from the cache; larger ones are worth
// several threads.
constexpr std::size_t kMaxBricksToCache = 256;
// From this many candidates on, lists of what each cluster requires pay for themselves.
constexpr std::size_t kMinMovesForLists = 8;

/// Each cluster's conflicts, as positions in the problem's list.
std::vector<std::vector<std::uint32_t>> conflicts_by_cluster(const DepthProblem& problem) {
  std::vector<std::vector<std::uint32_t>> out(problem.clusters.num_clusters);
  for (std::uint32_t i = 0; i < problem.conflicts.size(); ++i) {
    out[problem.conflicts[i].first].push_back(i);
    out[problem.conflicts[i].second].push_back(i);
  }
  return out;
}

bool is_forbidden(const Conflict& c, const std::vector<std::uint8_t>& labels) {
  return c.forbidden >> (8 * labels[c.first] + labels[c.second]) & 1;
}

/// The clusters that must follow when one takes a parity: all that it then excludes, and so on.
/// Equal parities never exclude each other, so this ends. `labels` is restored.
std::vector<std::uint32_t> followers(const DepthProblem& problem,
                                     const std::vector<std::vector<std::uint32_t>>& conflicts,
                                     std::uint32_t cluster, Parity parity,
                                     std::vector<std::uint8_t>& labels) {
  std::vector<std::uint32_t> moved = {cluster};
  std::vector<std::uint8_t> before = {labels[cluster]};
  labels[cluster] = static_cast<std::uint8_t>(parity);
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (const std::uint32_t index : conflicts[moved[i]]) {
      const Conflict& c = problem.conflicts[index];
      if (!is_forbidden(c, labels)) continue;
      const std::uint32_t other = c.first == moved[i] ? c.second : c.first;
      moved.push_back(other);
      before.push_back(labels[other]);
      labels[other] = static_cast<std::uint8_t>(parity);
    }
  for (std::size_t i = 0; i < moved.size(); ++i) labels[moved[i]] = before[i];
  return moved;
}

/// Clusters that depend on each other through conflicts; single ones left out.
std::vector<std::vector<std::uint32_t>> conflict_groups(
    const DepthProblem& problem, const std::vector<std::vector<std::uint32_t>>& conflicts) {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> is_seen(conflicts.size(), 0);
  for (std::uint32_t start = 0; start < conflicts.size(); ++start) {
    if (is_seen[start] || conflicts[start].empty()) continue;
    std::vector<std::uint32_t> group(1, start);
    is_seen[start] = 1;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const std::uint32_t index : conflicts[group[i]])
        for (const std::uint32_t other :
             {problem.conflicts[index].first, problem.conflicts[index].second})
          if (!is_seen[other]) {
            is_seen[other] = 1;
            group.push_back(other);
          }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// At most `count` clusters, those with the costliest labels, in order of their number.
std::vector<std::uint32_t> largest_clusters(const DepthProblem& problem,
                                            const std::vector<std::uint8_t>& labels,
                                            std::size_t count) {
  std::vector<std::uint32_t> out(labels.size());
  std::iota(out.begin(), out.end(), 0u);
  if (count >= out.size()) return out;
  std::stable_sort(out.begin(), out.end(), [&](std::uint32_t a, std::uint32_t b) {
    return problem.costs[a][labels[a]] > problem.costs[b][labels[b]];
  });
  out.resize(count);
  std::sort(out.begin(), out.end());
  return out;
}

std::int64_t total_cost(const DepthProblem& problem, const std::vector<std::uint8_t>& labels) {
  std::int64_t total = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) total += problem.costs[k][labels[k]];
  return total;
}

}  // namespace

Descent::Descent(const BlockSweep& sweep, const Context& context)
    : sweep_(sweep), context_(context) {}

void Descent::compute_bounds() {
  // Whatever is chosen, a depth splits the input's nodes and what balance alone forces; each of
  // their clusters costs at least its cheapest parity.
  const int num_depths = sweep_.num_depths();
  std::vector<std::int64_t> least(static_cast<std::size_t>(num_depths), 0);
  BrickSet certain;
  std::size_t sweep_work = 0;
  for (int d = num_depths - 1; d >= 0; --d) {
    certain = sweep_.required(d, certain);
    least[d] = sweep_.least_cost(certain, d);
    sweep_work += certain.num_bricks() + kWorkPerSet;
  }
  bound_above_.assign(static_cast<std::size_t>(num_depths) + 1, 0);
  for (int d = 0; d < num_depths; ++d) bound_above_[d + 1] = bound_above_[d] + least[d];
  budget_ =
      kWorkFactor * sweep_work + kSmallGridWork * kSmallSweep / std::max(kSmallSweep, sweep_work);
}

std::int64_t Descent::cost_above(const BrickSet& split, int depth, std::int64_t limit) {
  if (depth == 0) return 0;
  spend(split);
  return cost_from(sweep_.required(depth - 1, split), depth - 1, limit);
}

// A cost is remembered only when it was computed to the end: a search cut off by its limit knows no
// more than that the limit is reached.
std::int64_t Descent::cost_from(BrickSet required, int depth, std::int64_t limit) {
  const std::uint64_t hash = hash_of(required, static_cast<std::uint64_t>(depth) + 1);
  if (const auto known = cost_of_required_.find(hash); known != cost_of_required_.end())
    return known->second;
  spend(required);
  const DepthProblem problem = required.num_bricks() <= kMaxBricksToCache
                                   ? sweep_.pose(std::move(required), depth, cluster_costs_)
                                   : sweep_.pose(std::move(required), depth);
  const std::int64_t here = problem.solution.cost;
  if (here + bound_above(depth) >= limit) return limit;
  const BrickSet split = sweep_.split(problem, problem.solution.labels, depth);
  const std::int64_t total = here + cost_above(split, depth, limit - here);
  if (total < limit) cost_of_required_[hash] = total;
  return total;
}

std::vector<Descent::Move> Descent::list_moves(const DepthProblem& problem,
                                               const std::vector<std::uint8_t>& labels,
                                               std::size_t max_clusters) const {
  const auto conflicts = conflicts_by_cluster(problem);
  const std::int64_t cost = total_cost(problem, labels);
  auto scratch = labels;
  std::vector<Move> moves;
  const auto add = [&](std::vector<std::uint32_t> clusters, Parity p) {
    Move move{std::move(clusters), p, cost};
    for (const std::uint32_t k : move.clusters)
      move.cost += problem.costs[k][p] - problem.costs[k][labels[k]];
    moves.push_back(std::move(move));
  };
  std::vector<std::uint32_t> all(problem.clusters.num_clusters);
  std::iota(all.begin(), all.end(), 0u);
  const auto largest = largest_clusters(problem, labels, max_clusters);
  const auto groups = largest.size() == all.size() ? conflict_groups(problem, conflicts)
                                                   : std::vector<std::vector<std::uint32_t>>();
  for (Parity p = 0; p < kNumParities; ++p) {
    for (const std::uint32_t k : largest)
      if (p != labels[k]) add(followers(problem, conflicts, k, p, scratch), p);
    for (const auto& group : groups) add(group, p);
    add(all, p);
  }
  std::stable_sort(moves.begin(), moves.end(),
                   [](const Move& a, const Move& b) { return a.cost < b.cost; });
  return moves;
}

bool Descent::try_moves(const DepthProblem& problem, int depth, std::vector<std::uint8_t>& labels,
                        std::int64_t& best_total) {
  // Half of what is left for this depth: the coarser ones are cheaper to explore.
  const std::size_t stop = work_ + (budget_ - std::min(budget_, work_)) / 2;
  // No more candidates than the budget could ever try.
  const std::size_t work_per_move = problem.required.num_bricks() + kWorkPerSet;
  const std::size_t max_clusters = (stop - std::min(stop, work_)) / work_per_move;
  std::optional<ClusterRequirements> by_cluster;
  if (depth > 0 && max_clusters >= kMinMovesForLists) by_cluster.emplace(sweep_, problem, depth);
  const std::vector<std::uint8_t> start = labels;
  std::vector<std::uint8_t> best = labels;
  for (const Move& move : list_moves(problem, start, max_clusters)) {
    if (move.cost + bound_above(depth) >= best_total || work_ >= stop) break;
    context_.check_cancelled();
    std::vector<std::uint8_t> tried = start;
    for (const std::uint32_t k : move.clusters) tried[k] = static_cast<std::uint8_t>(move.parity);
    spend(problem.required);
    const std::int64_t limit = best_total - move.cost;
    const std::int64_t total =
        move.cost + (by_cluster ? cost_from(by_cluster->required(tried), depth - 1, limit)
                                : cost_above(sweep_.split(problem, tried, depth), depth, limit));
    if (total >= best_total) continue;
    best_total = total;
    best = std::move(tried);
  }
  labels = best;
  return best != start;
}

// Rounds of candidates from the best labelling so far, until a round brings nothing or the work is
// used up. The sweep's own labels are priced first: the result is never worse than theirs.
std::vector<std::uint8_t> Descent::choose_labels(const DepthProblem& problem, int depth) {
  std::vector<std::uint8_t> labels = problem.solution.labels;
  std::int64_t total =
      problem.solution.cost + cost_above(sweep_.split(problem, labels, depth), depth,
                                         std::numeric_limits<std::int64_t>::max());
  while (work_ < budget_ && try_moves(problem, depth, labels, total)) {
  }
  return labels;
}

NestedSets Descent::run(CompleteReport& report) {
  compute_bounds();
  const int num_depths = sweep_.num_depths();
  NestedSets out(static_cast<std::size_t>(num_depths));
  BrickSet none;
  for (int d = num_depths - 1; d >= 0; --d) {
    const DepthProblem problem =
        sweep_.pose(sweep_.required(d, d + 1 < num_depths ? out[d + 1] : none), d);
    count_problem(problem, report);
    out[d] = sweep_.split(problem, choose_labels(problem, d), d);
    context_.progress("complete", 1 - static_cast<double>(d) / num_depths);
  }
  return out;
}

}  // namespace hexwright::grids
