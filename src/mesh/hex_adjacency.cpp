#include "hexwright/mesh/hex_adjacency.h"

#include <algorithm>
#include <span>

#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

namespace hexwright {

/// Counting sort: counts, offsets, then placing in order of hexes, which leaves every row sorted.
VertToHex::VertToHex(const HexMesh& mesh) : offset_(mesh.num_verts() + 1, 0) {
  CancelCheck check_cancelled;
  for (const auto& hex : mesh.hexes) {
    check_cancelled();
    for (VertId v : hex) ++offset_[v.index() + 1];
  }
  for (std::size_t v = 0; v < mesh.num_verts(); ++v) offset_[v + 1] += offset_[v];
  corners_.resize(offset_.back());
  std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
  for (HexId h : mesh.hexes.ids()) {
    check_cancelled();
    for (int lv = 0; lv < 8; ++lv)
      corners_[next[mesh.hexes[h][static_cast<std::size_t>(lv)].index()]++] = {h, lv};
  }
}

namespace {

// A face in the bucket of its least vertex, with the others ascending: equal ones are the same
// quad.
struct KeyedFace {
  std::array<VertId, 3> others;
  HexFace face;
  bool is_like(const KeyedFace& f) const { return others == f.others; }
  friend bool operator<(const KeyedFace& x, const KeyedFace& y) {
    if (x.others != y.others) return x.others < y.others;
    return x.face.hex != y.face.hex ? x.face.hex < y.face.hex : x.face.lf < y.face.lf;
  }
};

// All faces, bucketed by least vertex: buckets are small, so sorting each takes linear time in all.
class FaceBuckets {
 public:
  explicit FaceBuckets(const HexMesh& mesh)
      : offset_(mesh.num_verts() + 1, 0), faces_(mesh.num_hexes() * 6) {
    const auto least = [&](const HexFace& face) {
      const auto quad = face_verts(mesh, face);
      return std::min(std::min(quad[0], quad[1]), std::min(quad[2], quad[3])).index();
    };
    CancelCheck check_cancelled;
    for (HexId h : mesh.hexes.ids()) {
      check_cancelled();
      for (int lf = 0; lf < 6; ++lf) ++offset_[least({h, lf}) + 1];
    }
    for (std::size_t v = 0; v < mesh.num_verts(); ++v) offset_[v + 1] += offset_[v];
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (HexId h : mesh.hexes.ids()) {
      check_cancelled();
      for (int lf = 0; lf < 6; ++lf) {
        auto key = face_verts(mesh, {h, lf});
        std::sort(key.begin(), key.end());
        faces_[next[key[0].index()]++] = {{key[1], key[2], key[3]}, {h, lf}};
      }
    }
  }

  std::span<KeyedFace> bucket(std::size_t v) {
    return {faces_.data() + offset_[v], faces_.data() + offset_[v + 1]};
  }

 private:
  std::vector<std::size_t> offset_;  // num_verts + 1
  std::vector<KeyedFace> faces_;
};

bool face_order(const HexFace& a, const HexFace& b) {
  return a.hex != b.hex ? a.hex < b.hex : a.lf < b.lf;
}

HexId& slot(HexNeighbors& adjacency, const HexFace& face) {
  return adjacency.neighbor[face.hex][static_cast<std::size_t>(face.lf)];
}

// Makes neighbours of the hexes of faces that come in twos.
void match_pairs(std::span<KeyedFace> bucket, HexNeighbors& adjacency) {
  std::sort(bucket.begin(), bucket.end());
  for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
    while (end < bucket.size() && bucket[end].is_like(bucket[begin])) ++end;
    if (end - begin != 2) continue;
    slot(adjacency, bucket[begin].face) = bucket[begin + 1].face.hex;
    slot(adjacency, bucket[begin + 1].face) = bucket[begin].face.hex;
  }
}

// Faces of a sorted bucket that were not matched: alone, or more than two.
void collect_unmatched(std::span<const KeyedFace> bucket, HexNeighbors& adjacency) {
  for (std::size_t i = 0; i < bucket.size(); ++i) {
    if (slot(adjacency, bucket[i].face).is_valid()) continue;
    const bool is_crowded = (i > 0 && bucket[i].is_like(bucket[i - 1])) ||
                            (i + 1 < bucket.size() && bucket[i].is_like(bucket[i + 1]));
    (is_crowded ? adjacency.non_conforming : adjacency.boundary).push_back(bucket[i].face);
  }
}

}  // namespace

HexNeighbors compute_hex_neighbors(const HexMesh& mesh) {
  HexNeighbors result;
  result.neighbor.resize(mesh.num_hexes());
  FaceBuckets buckets(mesh);
  parallel_for(mesh.num_verts(), [&](std::size_t v) { match_pairs(buckets.bucket(v), result); });
  CancelCheck check_cancelled;
  for (std::size_t v = 0; v < mesh.num_verts(); ++v) {
    check_cancelled();
    collect_unmatched(buckets.bucket(v), result);
  }
  std::sort(result.boundary.begin(), result.boundary.end(), face_order);
  std::sort(result.non_conforming.begin(), result.non_conforming.end(), face_order);
  return result;
}

}  // namespace hexwright
