// In rounds: each element that is not proven halves the offset that costs it most, until all are
// proven or straight. Shares only fall, so it ends.
#include "curving/hold_back.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "quality/jacobian/quadratic_jacobian.h"

namespace hexwright::curving {
namespace {

/// An element's Jacobian is to stay above this share of the least at its corners, when its edges
/// are straight: a hex with two faces on one smooth surface would lose all of it where they meet.
constexpr double kLeastShare = 0.1;
constexpr double kLeastStep = 1.0 / 16;  ///< below, an edge is straight

class HoldBack {
 public:
  HoldBack(const IdVector<EdgeId, Vec3>& offset, HexMesh& mesh)
      : offset_(offset),
        mesh_(mesh),
        verts_(edge_verts(mesh)),
        share_(offset.size(), 1.0),
        is_suspect_(mesh.num_hexes(), 0) {
    for (EdgeId e : offset_.ids()) place(e, 1);
    for (HexId h : mesh_.hexes.ids()) is_suspect_[h] = is_curved(h);
  }

  IdVector<EdgeId, double> run() {
    while (true) {
      const std::vector<HexId> broken = find_broken();
      if (broken.empty()) return std::move(share_);
      std::vector<EdgeId> worst(broken.size());
      parallel_for(
          broken.size(), [&](std::size_t i) { worst[i] = costliest_edge(broken[i]); }, 16);
      IdVector<EdgeId, char> is_changed(share_.size(), 0);
      for (EdgeId e : worst) is_changed[e] = 1;
      for (EdgeId e : is_changed.ids())
        if (is_changed[e]) place(e, lowered(e));
      for (HexId h : mesh_.hexes.ids())
        for (EdgeId e : edges_of(h))
          if (is_changed[e] && is_curved(h)) is_suspect_[h] = 1;
    }
  }

 private:
  const std::array<EdgeId, 12>& edges_of(HexId h) const { return mesh_.mid_nodes->hex_to_edge[h]; }
  bool is_bent(EdgeId e) const { return share_[e] > 0 && norm_sq(offset_[e]) > 0; }
  bool is_curved(HexId h) const {
    return std::any_of(edges_of(h).begin(), edges_of(h).end(),
                       [&](EdgeId e) { return is_bent(e); });
  }
  double lowered(EdgeId e) const { return share_[e] > kLeastStep ? 0.5 * share_[e] : 0; }

  Vec3 at(EdgeId e, double share) const {
    const auto& [a, b] = verts_[e];
    return 0.5 * mesh_.positions[a] + 0.5 * mesh_.positions[b] + share * offset_[e];
  }
  void place(EdgeId e, double share) {
    share_[e] = share;
    mesh_.mid_nodes->edges[e] = at(e, share);
  }

  /// What the Jacobian is not to fall to.
  double floor_of(HexId h) const {
    const auto corners = mesh_.corners(h);
    double least = corner_shape(corners, 0).det;
    for (int lv = 1; lv < 8; ++lv) least = std::min(least, corner_shape(corners, lv).det);
    return kLeastShare * std::max(0.0, least);
  }

  /// Of the suspects; none is one afterwards.
  std::vector<HexId> find_broken() {
    IdVector<HexId, char> is_broken(mesh_.num_hexes(), 0);
    parallel_for(
        mesh_.num_hexes(),
        [&](std::size_t i) {
          const HexId h(i);
          if (is_suspect_[h])
            is_broken[h] =
                check_positivity(quadratic_hex(mesh_, h), floor_of(h)) != Positivity::Positive;
          is_suspect_[h] = 0;
        },
        64);
    std::vector<HexId> broken;
    for (HexId h : is_broken.ids())
      if (is_broken[h]) broken.push_back(h);
    return broken;
  }

  /// The edge whose next step back leaves the largest least coefficient.
  EdgeId costliest_edge(HexId h) const {
    EdgeId best;
    double best_least = 0;
    QuadraticHex nodes = quadratic_hex(mesh_, h);
    for (std::size_t le = 0; le < 12; ++le) {
      const EdgeId e = edges_of(h)[le];
      if (!is_bent(e)) continue;
      const Vec3 present = nodes[8 + le];
      nodes[8 + le] = at(e, lowered(e));
      fill_inner_nodes(nodes);
      const QuadraticBezier bezier = compute_quadratic_bezier(nodes);
      const double least = *std::min_element(bezier.begin(), bezier.end());
      if (!best.is_valid() || least > best_least) {
        best = e;
        best_least = least;
      }
      nodes[8 + le] = present;
    }
    return best;
  }

  const IdVector<EdgeId, Vec3>& offset_;
  HexMesh& mesh_;
  IdVector<EdgeId, std::array<VertId, 2>> verts_;
  IdVector<EdgeId, double> share_;
  IdVector<HexId, char> is_suspect_;
};

}  // namespace

IdVector<EdgeId, double> hold_back(const IdVector<EdgeId, Vec3>& offset, HexMesh& mesh) {
  return HoldBack(offset, mesh).run();
}

}  // namespace hexwright::curving
