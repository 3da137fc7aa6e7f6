// What each block parity costs a cluster, and which parities of close clusters exclude each other.
//
// The blocks of one parity partition the lattice, so a cluster's blocks are counted by their
// representatives: the required node that comes first in its block in (z, y, x) order.
#include <algorithm>

#include "hexwright/base/parallel.h"

#include "grid/pairing/blocks.h"
#include "grid/pairing/clusters.h"
#include "grid/sets/hash.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kBricksPerChunk = 256;

/// A brick's word and its neighbours' along one axis, read at node offsets -1, 0 and +1.
constexpr std::array<BrickBits, 3> read_shifted(BrickBits lower, BrickBits own, BrickBits upper,
                                                int axis) {
  return {shift_up(own, axis) | move_slice(lower, axis, 3, 0), own,
          shift_down(own, axis) | move_slice(upper, axis, 0, 3)};
}

/// One step of shifted_words(); the axis is a constant so that no index is divided at run time.
template <int kAxis>
void shift_along(std::array<BrickBits, 27>& words) {
  constexpr int kStride = kAxis == 0 ? 1 : kAxis == 1 ? 3 : 9;
  for (int line = 0; line < 9; ++line) {
    const int n = line / kStride * 3 * kStride + line % kStride;
    const auto read = read_shifted(words[n], words[n + kStride], words[n + 2 * kStride], kAxis);
    for (int k = 0; k < 3; ++k) words[n + k * kStride] = read[k];
  }
}

/// Entry n: bit c tells whether node c + offset n is required, for the 27 offsets of
/// neighbour_number(). Axis by axis, so that each step reads three words.
std::array<BrickBits, 27> shifted_words(std::array<BrickBits, 27> words) {
  shift_along<0>(words);
  shift_along<1>(words);
  shift_along<2>(words);
  return words;
}

/// Bits whose place in their block of the given parity is `place` (bit a: upper along axis a).
constexpr BrickBits place_mask(Parity parity, int place) {
  BrickBits mask = ~BrickBits{0};
  for (int a = 0; a < 3; ++a) {
    // Odd centre: pairs (0,1) (2,3), upper = odd coordinate. Even centre: the other way round.
    const int first = ((parity >> a & 1) == 1) == ((place >> a & 1) == 1) ? 1 : 0;
    mask &= slice(a, first) | slice(a, first + 2);
  }
  return mask;
}

using PlaceMasks = std::array<std::array<BrickBits, 8>, kNumParities>;
constexpr PlaceMasks make_place_masks() {
  PlaceMasks masks{};
  for (Parity p = 0; p < kNumParities; ++p)
    for (int place = 0; place < 8; ++place) masks[p][place] = place_mask(p, place);
  return masks;
}
constexpr PlaceMasks kPlaceMasks = make_place_masks();

/// Neighbour number of the step from one place of a block to another.
constexpr int step_number(int from, int to) {
  return neighbour_number((to & 1) - (from & 1), (to >> 1 & 1) - (from >> 1 & 1),
                          (to >> 2) - (from >> 2));
}

/// Per parity: the nodes of `own` that come first in their block.
std::array<BrickBits, kNumParities> representatives(BrickBits own,
                                                    const std::array<BrickBits, 27>& around) {
  const auto shifted = shifted_words(around);
  // Per place: nodes that have an earlier required node in their block, were that their place.
  std::array<BrickBits, 8> has_earlier{};
  for (int place = 1; place < 8; ++place)
    for (int before = 0; before < place; ++before)
      has_earlier[place] |= shifted[step_number(place, before)];
  std::array<BrickBits, kNumParities> out{};
  for (Parity p = 0; p < kNumParities; ++p)
    for (int place = 0; place < 8; ++place)
      out[p] |= own & kPlaceMasks[p][place] & ~has_earlier[place];
  return out;
}

using Neighbourhood = std::array<BrickBits, 27>;

/// The nodes of a brick and its neighbours that exist.
Neighbourhood domain_masks(BrickKey key, int depth, const LatticeDomain& domain) {
  Neighbourhood masks;
  const auto keys = neighbour_keys(key);
  for (int n = 0; n < 27; ++n) masks[n] = domain.neighbour_mask(key, keys[n], depth);
  return masks;
}

/// Number of existing nodes in the blocks that cover some nodes, no two of them in one block.
int count_block_nodes(BrickBits representatives, Parity parity, const Neighbourhood& masks) {
  if (representatives == 0) return 0;
  const auto grown = grow_to_blocks(representatives, parity);
  int count = 0;
  for (int n = 0; n < 27; ++n)
    if (grown[n] & masks[n]) count += count_bits(grown[n] & masks[n]);  // few are reached
  return count;
}

using PieceCosts = ClusterCostCache::PieceCosts;

/// Whose pieces, where.
struct PieceCostQuery {
  const BrickSet& required;
  const Clusters& clusters;
  int depth;
  const LatticeDomain& domain;
};

/// Costs of the pieces of one brick.
void brick_costs(const PieceCostQuery& query, std::uint32_t b, const Neighbourhood& around,
                 std::vector<PieceCosts>& costs) {
  const auto& [required, clusters, depth, domain] = query;
  const Brick& brick = required.bricks()[b];
  const auto first = representatives(brick.bits, around);
  const bool is_interior = domain.is_interior(brick.key, depth);
  const Neighbourhood masks =
      is_interior ? Neighbourhood{} : domain_masks(brick.key, depth, domain);
  for (std::uint32_t i = clusters.brick_offset[b]; i < clusters.brick_offset[b + 1]; ++i)
    for (Parity p = 0; p < kNumParities; ++p) {
      const BrickBits mine = first[p] & clusters.pieces[i].bits;
      costs[i][p] = is_interior ? 8 * count_bits(mine) : count_block_nodes(mine, p, masks);
    }
}

std::vector<std::array<std::int64_t, kNumParities>> sums_by_cluster(
    const std::vector<PieceCosts>& by_piece, const Clusters& clusters) {
  std::vector<std::array<std::int64_t, kNumParities>> out(clusters.num_clusters);
  for (auto& costs : out) costs.fill(0);
  for (std::size_t i = 0; i < by_piece.size(); ++i)
    for (Parity p = 0; p < kNumParities; ++p) out[clusters.pieces[i].cluster][p] += by_piece[i][p];
  return out;
}

/// Forbidden parity pairs by the first node's coordinate parities and the offset to the second.
class ConflictTable {
 public:
  ConflictTable() : tables_(8 * 729, 0) {
    for (int own = 0; own < 8; ++own)
      for (int dz = -4; dz <= 4; ++dz)
        for (int dy = -4; dy <= 4; ++dy)
          for (int dx = -4; dx <= 4; ++dx)
            tables_[slot(own, dx, dy, dz)] = compute(own, {dx, dy, dz});
  }
  PairTable at(const LatticeCoord& a, const LatticeCoord& b) const {
    const int own = (a[0] & 1) | (a[1] & 1) << 1 | (a[2] & 1) << 2;
    return tables_[slot(own, b[0] - a[0], b[1] - a[1], b[2] - a[2])];
  }

 private:
  static std::size_t slot(int own, int dx, int dy, int dz) {
    return static_cast<std::size_t>(own * 729 + (dx + 4) + 9 * (dy + 4) + 81 * (dz + 4));
  }
  static PairTable compute(int own, const LatticeCoord& offset) {
    const LatticeCoord a = {own & 1, own >> 1 & 1, own >> 2};
    const LatticeCoord b = {a[0] + offset[0], a[1] + offset[1], a[2] + offset[2]};
    PairTable table = 0;
    for (Parity p = 0; p < kNumParities; ++p)
      for (Parity q = 0; q < kNumParities; ++q) {
        const LatticeCoord v = block_center(a, p), w = block_center(b, q);
        if (is_block_conflict({w[0] - v[0], w[1] - v[1], w[2] - v[2]}))
          table |= PairTable{1} << (8 * p + q);
      }
    return table;
  }
  std::vector<PairTable> tables_;
};

/// Forbidden pairs of two sets of nodes in (possibly) different bricks.
PairTable forbidden_pairs(const ConflictTable& table, BrickKey key_a, BrickBits a, BrickKey key_b,
                          BrickBits b) {
  PairTable out = 0;
  for (BrickBits rest_a = a; rest_a != 0; rest_a &= rest_a - 1) {
    const LatticeCoord node_a = node_of_bit(key_a, std::countr_zero(rest_a));
    for (BrickBits rest_b = b; rest_b != 0; rest_b &= rest_b - 1) {
      const LatticeCoord node_b = node_of_bit(key_b, std::countr_zero(rest_b));
      bool is_close = true;
      for (int k = 0; k < 3; ++k) is_close = is_close && std::abs(node_a[k] - node_b[k]) <= 4;
      if (is_close) out |= table.at(node_a, node_b);
    }
  }
  return out;
}

PairTable transposed(PairTable table) {
  PairTable out = 0;
  for (Parity p = 0; p < kNumParities; ++p)
    for (Parity q = 0; q < kNumParities; ++q)
      if (table >> (8 * p + q) & 1) out |= PairTable{1} << (8 * q + p);
  return out;
}

void brick_conflicts(const BrickSet& required, const Clusters& clusters, std::uint32_t b,
                     const ConflictTable& table, std::vector<Conflict>& out) {
  const BrickKey key = required.bricks()[b].key;
  const auto keys = neighbour_keys(key);
  for (int n = 13; n < 27; ++n) {
    const std::uint32_t other = n == 13 ? b : required.find(keys[n]);
    if (other == BrickSet::kAbsent) continue;
    for (std::uint32_t i = clusters.brick_offset[b]; i < clusters.brick_offset[b + 1]; ++i)
      for (std::uint32_t j = clusters.brick_offset[other]; j < clusters.brick_offset[other + 1];
           ++j) {
        const Piece& p = clusters.pieces[i];
        const Piece& q = clusters.pieces[j];
        if (p.cluster == q.cluster || (n == 13 && j <= i)) continue;
        const PairTable t = forbidden_pairs(table, key, p.bits, keys[n], q.bits);
        if (t == 0) continue;
        if (p.cluster < q.cluster)
          out.push_back({p.cluster, q.cluster, t});
        else
          out.push_back({q.cluster, p.cluster, transposed(t)});
      }
  }
}

void merge_conflicts(std::vector<Conflict>& conflicts) {
  std::sort(conflicts.begin(), conflicts.end(), [](const Conflict& a, const Conflict& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  std::size_t num_kept = 0;
  for (const Conflict& c : conflicts) {
    if (num_kept > 0 && conflicts[num_kept - 1].first == c.first &&
        conflicts[num_kept - 1].second == c.second)
      conflicts[num_kept - 1].forbidden |= c.forbidden;
    else
      conflicts[num_kept++] = c;
  }
  conflicts.resize(num_kept);
}

}  // namespace

std::vector<std::array<std::int64_t, kNumParities>> block_costs(const BrickSet& required,
                                                                const Clusters& clusters, int depth,
                                                                const LatticeDomain& domain) {
  std::vector<PieceCosts> by_piece(clusters.pieces.size());
  const PieceCostQuery query{required, clusters, depth, domain};
  parallel_for(
      required.num_bricks(),
      [&](std::size_t b) {
        brick_costs(query, static_cast<std::uint32_t>(b),
                    required.neighbourhood(required.bricks()[b].key), by_piece);
      },
      kBricksPerChunk);
  return sums_by_cluster(by_piece, clusters);
}

namespace {

/// Of everything that the costs of a brick's pieces depend on, but for the piece itself.
std::uint64_t neighbourhood_hash(BrickKey key, int depth, const Neighbourhood& around) {
  std::uint64_t hash = mix_bits(key ^ static_cast<std::uint64_t>(depth) << 58);
  for (const BrickBits w : around) hash = (hash ^ hash >> 32 ^ w) * 0x9e3779b97f4a7c15u;
  return hash;
}

}  // namespace

std::vector<std::array<std::int64_t, kNumParities>> ClusterCostCache::costs(
    const BrickSet& required, const Clusters& clusters, int depth, const LatticeDomain& domain) {
  std::vector<PieceCosts> by_piece(clusters.pieces.size());
  for (std::uint32_t b = 0; b < required.num_bricks(); ++b) {
    const BrickKey key = required.bricks()[b].key;
    const Neighbourhood around = required.neighbourhood(key);
    const std::uint64_t hash = neighbourhood_hash(key, depth, around);
    bool is_computed = false;
    for (std::uint32_t i = clusters.brick_offset[b]; i < clusters.brick_offset[b + 1]; ++i) {
      const auto [entry, is_new] =
          known_.try_emplace(mix_bits(hash ^ mix_bits(clusters.pieces[i].bits)));
      if (!is_new) {
        by_piece[i] = entry->second;
        continue;
      }
      if (!is_computed) brick_costs({required, clusters, depth, domain}, b, around, by_piece);
      is_computed = true;
      entry->second = by_piece[i];
    }
  }
  return sums_by_cluster(by_piece, clusters);
}

std::vector<Conflict> find_conflicts(const BrickSet& required, const Clusters& clusters) {
  if (clusters.num_clusters < 2) return {};
  static const ConflictTable kTable;
  const std::size_t num_chunks = (required.num_bricks() + kBricksPerChunk - 1) / kBricksPerChunk;
  std::vector<std::vector<Conflict>> by_chunk(num_chunks);
  parallel_chunks(required.num_bricks(), kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    auto& list = by_chunk[begin / kBricksPerChunk];
    for (std::size_t b = begin; b < end; ++b)
      brick_conflicts(required, clusters, static_cast<std::uint32_t>(b), kTable, list);
    merge_conflicts(list);
  });
  std::vector<Conflict> all;
  for (auto& list : by_chunk) all.insert(all.end(), list.begin(), list.end());
  merge_conflicts(all);
  return all;
}

}  // namespace hexwright::grids
