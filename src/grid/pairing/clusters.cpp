// Cluster finding by union-find over bricks.
#include "grid/pairing/clusters.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "base/disjoint_sets.h"

namespace hexwright::grids {
namespace {

constexpr std::size_t kBricksPerChunk = 256;

/// Everything within two nodes of `w`, except at offset (+-2,+-2,+-2), that lands in the neighbour
/// brick at `side`: the union of three boxes, each one node shorter along one axis.
BrickBits related(BrickBits w, const std::array<int, 3>& side) {
  BrickBits out = 0;
  for (int shorter = 0; shorter < 3; ++shorter) {
    BrickBits box = w;
    for (int a = 0; a < 3; ++a)
      box = spread_axis(box, a, a == shorter ? Spread::One : Spread::Two, side[a]);
    out |= box;
  }
  return out;
}

/// The connected part of `w` that holds its lowest bit, inside the brick.
BrickBits first_component(BrickBits w) {
  BrickBits component = w & (~w + 1);
  for (;;) {
    const BrickBits grown = related(component, {0, 0, 0}) & w;
    if (grown == component) return component;
    component = grown;
  }
}

/// Splits every brick into its connected parts; a brick's number of parts goes to the entry of
/// brick_offset after its own.
void make_chunk_pieces(std::span<const Brick> bricks, std::size_t begin, std::size_t end,
                       std::vector<Piece>& pieces, std::uint32_t* num_parts) {
  pieces.reserve(end - begin);
  for (std::size_t b = begin; b < end; ++b) {
    const std::size_t first = pieces.size();
    for (BrickBits rest = bricks[b].bits; rest != 0;) {
      const BrickBits component = first_component(rest);
      pieces.push_back({static_cast<std::uint32_t>(b), 0, component});
      rest &= ~component;
    }
    num_parts[b] = static_cast<std::uint32_t>(pieces.size() - first);
  }
}

void make_pieces(const BrickSet& required, Clusters& out) {
  const auto bricks = required.bricks();
  out.brick_offset.assign(bricks.size() + 1, 0);
  std::vector<std::vector<Piece>> lists((bricks.size() + kBricksPerChunk - 1) / kBricksPerChunk);
  parallel_chunks(bricks.size(), kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    make_chunk_pieces(bricks, begin, end, lists[begin / kBricksPerChunk],
                      out.brick_offset.data() + 1);
  });
  for (std::size_t b = 0; b < bricks.size(); ++b) out.brick_offset[b + 1] += out.brick_offset[b];
  if (lists.size() == 1) {
    out.pieces = std::move(lists.front());
    return;
  }
  out.pieces.resize(out.brick_offset.back());
  parallel_for(
      lists.size(),
      [&](std::size_t i) {
        std::copy(lists[i].begin(), lists[i].end(),
                  out.pieces.begin() + out.brick_offset[i * kBricksPerChunk]);
      },
      1);
}

using PiecePair = std::pair<std::uint32_t, std::uint32_t>;

/// Related pieces of brick b and of its neighbours later in neighbour order.
void collect_links(const BrickSet& required, const Clusters& clusters, std::uint32_t b,
                   std::vector<PiecePair>& links) {
  const auto keys = neighbour_keys(required.bricks()[b].key);
  for (int n = 14; n < 27; ++n) {
    const std::uint32_t other = required.find(keys[n]);
    if (other == BrickSet::kAbsent) continue;
    const std::array<int, 3> side = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    for (std::uint32_t p = clusters.brick_offset[b]; p < clusters.brick_offset[b + 1]; ++p) {
      const BrickBits reach = related(clusters.pieces[p].bits, side);
      if (reach == 0) continue;
      for (std::uint32_t q = clusters.brick_offset[other]; q < clusters.brick_offset[other + 1];
           ++q)
        if (reach & clusters.pieces[q].bits) links.push_back({p, q});
    }
  }
}

std::vector<std::vector<PiecePair>> find_links(const BrickSet& required, const Clusters& clusters) {
  const std::size_t num_bricks = required.num_bricks();
  std::vector<std::vector<PiecePair>> links((num_bricks + kBricksPerChunk - 1) / kBricksPerChunk);
  parallel_chunks(num_bricks, kBricksPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      collect_links(required, clusters, static_cast<std::uint32_t>(b),
                    links[begin / kBricksPerChunk]);
  });
  return links;
}

}  // namespace

// Pieces and links are found in parallel, united one after the other in the order of bricks: the
// smaller piece survives a union, so clusters come out numbered by their first piece whatever the
// chunks.
Clusters find_clusters(const BrickSet& required) {
  Clusters out;
  make_pieces(required, out);
  BasicDisjointSets<std::uint32_t> sets(out.pieces.size());
  for (const auto& chunk : find_links(required, out))
    for (const auto& [p, q] : chunk) sets.unite(p, q);
  for (std::uint32_t p = 0; p < out.pieces.size(); ++p) {
    const std::uint32_t root = sets.find(p);
    out.pieces[p].cluster =
        root == p ? static_cast<std::uint32_t>(out.num_clusters++) : out.pieces[root].cluster;
  }
  return out;
}

}  // namespace hexwright::grids
