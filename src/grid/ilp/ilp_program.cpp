// Builds the integer programs of block pairing.
//
// Variables: one per block (vertex of a depth's lattice). Two blocks that overlap exclude each
// other, so "node c is split" is simply the sum of the blocks that hold c, and the objective is the
// sum of the chosen blocks' sizes.
//
// Differs from the plain program in one respect, for the whole hierarchy: nodes that are required
// whatever is chosen, and belong to one cluster, must take blocks of one parity
// (docs/algorithms/pairing.md), so their blocks of each parity share one variable.
#include "grid/ilp/ilp_program.h"

#include <algorithm>
#include <set>

#include "grid/pairing/balance.h"
#include "grid/pairing/blocks.h"

namespace hexwright::grids {
namespace {

constexpr double kInf = IlpModel::kInfinity;

template <class Body>
void for_each_node(const BrickSet& set, Body&& body) {
  for (const Brick& brick : set.bricks())
    for (BrickBits rest = brick.bits; rest != 0; rest &= rest - 1)
      body(node_of_bit(brick.key, std::countr_zero(rest)));
}

/// The eight nodes around a vertex.
LatticeCoord node_at_vertex(const LatticeCoord& v, int q) {
  return {v[0] - (q & 1), v[1] - (q >> 1 & 1), v[2] - (q >> 2)};
}

BrickSet block_nodes(const LatticeCoord& v, int depth, const LatticeDomain& domain) {
  std::vector<Brick> bricks;
  for (int q = 0; q < 8; ++q) {
    const LatticeCoord c = node_at_vertex(v, q);
    if (domain.contains(c, depth))
      bricks.push_back({brick_of_node(c), BrickBits{1} << bit_of_node(c)});
  }
  return BrickSet(std::move(bricks));
}

/// The blocks of one depth and their columns.
struct BlockColumns {
  std::map<LatticeCoord, std::int32_t> column_of;  ///< by centre; several may share a column
  std::int32_t at(const LatticeCoord& v) const {
    const auto it = column_of.find(v);
    return it == column_of.end() ? -1 : it->second;
  }
  /// The distinct columns of the blocks that hold a node.
  std::vector<std::int32_t> covering(const LatticeCoord& node) const {
    std::vector<std::int32_t> out;
    for (Parity p = 0; p < kNumParities; ++p)
      if (const auto column = at(block_center(node, p)); column >= 0) out.push_back(column);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
};

class ProgramBuilder {
 public:
  ProgramBuilder(const LatticeDomain& domain, Balance balance)
      : domain_(domain), balance_(balance) {}

  /// One column per vertex that touches `nodes`.
  BlockColumns add_blocks(const BrickSet& nodes, int depth) {
    std::set<LatticeCoord> centers;
    for_each_node(nodes, [&](const LatticeCoord& c) {
      for (Parity p = 0; p < kNumParities; ++p) centers.insert(block_center(c, p));
    });
    BlockColumns out;
    for (const LatticeCoord& v : centers) out.column_of[v] = add_column(v, depth);
    return out;
  }

  /// As add_blocks, but the blocks of one parity on one cluster of `certain` share a column.
  BlockColumns add_shared_blocks(const BrickSet& nodes, const BrickSet& certain, int depth) {
    BlockColumns out;
    const Clusters clusters = find_clusters(certain);
    std::map<std::pair<std::uint32_t, Parity>, std::int32_t> shared;
    for (const Piece& piece : clusters.pieces)
      for (BrickBits rest = piece.bits; rest != 0; rest &= rest - 1) {
        const LatticeCoord c =
            node_of_bit(certain.bricks()[piece.brick].key, std::countr_zero(rest));
        for (Parity p = 0; p < kNumParities; ++p) {
          const LatticeCoord v = block_center(c, p);
          if (out.column_of.count(v)) continue;
          const auto [it, is_new] = shared.try_emplace({piece.cluster, p}, model_.num_columns());
          if (is_new) model_.add_binary(0);
          out.column_of[v] = it->second;
        }
      }
    for_each_node(nodes, [&](const LatticeCoord& c) {
      for (Parity p = 0; p < kNumParities; ++p) {
        const LatticeCoord v = block_center(c, p);
        if (!out.column_of.count(v)) out.column_of[v] = model_.add_binary(0);
      }
    });
    for (const auto& [v, column] : out.column_of) add_cost(column, v, depth);
    return out;
  }

  /// Every node of `required` lies in a block.
  void add_cover(const BrickSet& required, const BlockColumns& blocks) {
    std::set<std::vector<std::int32_t>> rows;
    for_each_node(required, [&](const LatticeCoord& c) { rows.insert(blocks.covering(c)); });
    for (const auto& columns : rows) model_.add_row(terms(columns), 1, kInf);
  }

  /// The pairwise exclusions: all offsets that conflict.
  void add_exclusions(const BlockColumns& blocks) {
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    for (const auto& [v, column] : blocks.column_of)
      for (int n = 0; n < 343; ++n) {
        const LatticeCoord o = {n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3};
        if (!is_block_conflict(o)) continue;
        const auto other = blocks.at({v[0] + o[0], v[1] + o[1], v[2] + o[2]});
        if (other > column) pairs.insert({column, other});
      }
    for (const auto& [a, b] : pairs) model_.add_row({{a, 1}, {b, 1}}, -kInf, 1);
  }

  /// A block needs the parents of its nodes and of their neighbours: rule (B).
  void add_balance(const BlockColumns& blocks, const BlockColumns& above, const BrickSet& certain,
                   int depth) {
    std::set<std::pair<std::int32_t, LatticeCoord>> needs;
    for (const auto& [v, column] : blocks.column_of) {
      const BrickSet needed =
          required_above(block_nodes(v, depth, domain_), depth, balance_, domain_, BrickSet());
      for_each_node(needed, [&, column = column](const LatticeCoord& m) {
        if (!certain.contains(m)) needs.insert({column, m});
      });
    }
    for (const auto& [column, m] : needs) {
      auto row = terms(above.covering(m));
      row.push_back({column, -1});
      model_.add_row(row, 0, kInf);
    }
  }

  IlpModel& model() { return model_; }

 private:
  static std::vector<IlpTerm> terms(const std::vector<std::int32_t>& columns) {
    std::vector<IlpTerm> out;
    for (const std::int32_t c : columns) out.push_back({c, 1});
    return out;
  }
  std::int32_t add_column(const LatticeCoord& v, int depth) {
    return model_.add_binary(static_cast<double>(block_nodes(v, depth, domain_).num_nodes()));
  }
  void add_cost(std::int32_t column, const LatticeCoord& v, int depth) {
    model_.add_cost(column, static_cast<double>(block_nodes(v, depth, domain_).num_nodes()));
  }

  const LatticeDomain& domain_;
  Balance balance_;
  IlpModel model_;
};

BrickSet chosen_nodes(const BlockColumns& blocks, const IlpSolution& solution, int depth,
                      const LatticeDomain& domain) {
  std::vector<Brick> bricks;
  for (const auto& [v, column] : blocks.column_of) {
    if (!solution.values[static_cast<std::size_t>(column)]) continue;
    const BrickSet nodes = block_nodes(v, depth, domain);
    bricks.insert(bricks.end(), nodes.bricks().begin(), nodes.bricks().end());
  }
  return BrickSet(std::move(bricks));
}

/// Every node that some block over `nodes` holds.
BrickSet any_block(const BrickSet& nodes, int depth, const LatticeDomain& domain) {
  std::vector<Brick> all;
  for (Parity p = 0; p < kNumParities; ++p) {
    const BrickSet grown = blocks_of_parity(nodes, p, depth, domain);
    all.insert(all.end(), grown.bricks().begin(), grown.bricks().end());
  }
  return BrickSet(std::move(all));
}

/// Marks the columns of a completed hierarchy's own blocks.
void mark_start(const BrickSet& split, const BlockColumns& blocks, int depth,
                const LatticeDomain& domain, std::vector<char>& values) {
  const Clusters clusters = find_clusters(split);
  const auto costs = block_costs(split, clusters, depth, domain);
  std::vector<std::int64_t> sizes(clusters.num_clusters, 0);
  for (const Piece& p : clusters.pieces) sizes[p.cluster] += std::popcount(p.bits);
  for (const Piece& piece : clusters.pieces) {
    const auto& c = costs[piece.cluster];
    const auto parity =
        static_cast<Parity>(std::find(c.begin(), c.end(), sizes[piece.cluster]) - c.begin());
    for (BrickBits rest = piece.bits; rest != 0; rest &= rest - 1) {
      const LatticeCoord node =
          node_of_bit(split.bricks()[piece.brick].key, std::countr_zero(rest));
      const auto column = blocks.at(block_center(node, parity));
      if (column >= 0) values[static_cast<std::size_t>(column)] = 1;
    }
  }
}

}  // namespace

IlpSolution solve_depth_program(const BrickSet& required, const BrickSet& nodes, int depth,
                                const LatticeDomain& domain, double time_limit_seconds,
                                BrickSet* split) {
  ProgramBuilder builder(domain, Balance::Weak);
  const BlockColumns blocks = builder.add_blocks(nodes, depth);
  builder.add_cover(required, blocks);
  builder.add_exclusions(blocks);
  IlpSolution solution = builder.model().solve({}, time_limit_seconds);
  if (split && !solution.values.empty()) *split = chosen_nodes(blocks, solution, depth, domain);
  return solution;
}

IlpSolution solve_hierarchy_program(const NestedSets& input, const NestedSets& start,
                                    Balance balance, const LatticeDomain& domain,
                                    double time_limit_seconds, NestedSets* split) {
  const int num_depths = static_cast<int>(input.size());
  NestedSets certain(input.size()), possible(input.size());
  std::vector<BlockColumns> blocks(input.size());
  ProgramBuilder builder(domain, balance);
  for (int d = num_depths - 1; d >= 0; --d) {
    if (d + 1 == num_depths) {
      certain[d] = possible[d] = input[d];
    } else {
      certain[d] = required_above(certain[d + 1], d + 1, balance, domain, input[d]);
      possible[d] = required_above(any_block(possible[d + 1], d + 1, domain), d + 1, balance,
                                   domain, input[d]);
    }
    blocks[d] = builder.add_shared_blocks(possible[d], certain[d], d);
    builder.add_cover(certain[d], blocks[d]);
    builder.add_exclusions(blocks[d]);
    if (d + 1 < num_depths) builder.add_balance(blocks[d + 1], blocks[d], certain[d], d + 1);
  }
  std::vector<char> values;
  if (!start.empty()) {
    values.assign(static_cast<std::size_t>(builder.model().num_columns()), 0);
    for (int d = 0; d < num_depths; ++d) mark_start(start[d], blocks[d], d, domain, values);
  }
  IlpSolution solution = builder.model().solve(values, time_limit_seconds);
  if (split && !solution.values.empty())
    for (int d = 0; d < num_depths; ++d)
      split->push_back(chosen_nodes(blocks[d], solution, d, domain));
  return solution;
}

}  // namespace hexwright::grids
