// Branch and bound over pieces of triangles.
//
// Based on: Tang, Lee, Kim, "Interactive Hausdorff Distance Computation for General Polygonal
// Models", ACM TOG 28(3), 2009 (bounds by one triangle of the other surface: the distance to a
// convex set is convex, so that it is largest at a piece's corners).
// Differs: a piece that reaches beyond the space over the nearest triangle is cut along it, so that
// flat surfaces take as many pieces as their triangles overlap, and not as many as the gap asks
// for.
#include "quality/distance/distance_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hexwright/base/parallel.h"

#include "geometry/tree/triangle_math.h"
#include "quality/distance/convex_piece.h"

namespace hexwright {
namespace {

constexpr std::size_t kGrain = 64;
/// Pieces per triangle of a chunk, and per triangle of the reference for all of them, after which
/// the gap doubles: a bound in finite time for whatever shape.
constexpr double kPiecesPerTri = 64, kPiecesPerReference = 16;
/// Cuts leave what reaches less than this share of the gap beyond them.
constexpr double kSliver = 0.1;

using Values = std::array<double, ConvexPiece::kMaxVerts>;

struct Found {
  DistanceBounds bounds;
  void take(const Found& other) {
    if (other.bounds.lower > bounds.lower) {
      bounds.lower = other.bounds.lower;
      bounds.worst = other.bounds.worst;
    }
    bounds.upper = std::max(bounds.upper, other.bounds.upper);
    bounds.open_upper = std::max(bounds.open_upper, other.bounds.open_upper);
    bounds.open.insert(bounds.open.end(), other.bounds.open.begin(), other.bounds.open.end());
    bounds.coarse.insert(bounds.coarse.end(), other.bounds.coarse.begin(),
                         other.bounds.coarse.end());
  }
};

/// The triangles of one chunk.
class PieceBounder {
 public:
  PieceBounder(const BoundInput& input, std::size_t num_tris, double share)
      : input_(input),
        gap_(input.gap),
        budget_(static_cast<std::size_t>(
            kPiecesPerTri * static_cast<double>(num_tris) +
            share * kPiecesPerReference *
                static_cast<double>(input.reference.all.tree->surface().num_tris()))),
        finder_(input.reference) {
    found_.bounds.lower = input.lower;
    found_.bounds.worst = input.worst;
  }

  void bound(TriId t) {
    const std::array<Vec3, 3> corners = input_.sampled.corners(t);
    own_error_ = input_.sampled_error.empty() ? 0 : input_.sampled_error[t.index()];
    if (is_bounded_by_corners(t, corners)) return;
    is_open_ = false;
    stack_.assign(1, {ConvexPiece(corners), {}});
    while (!stack_.empty()) {
      const Entry entry = stack_.back();
      stack_.pop_back();
      take(entry);
    }
    if (is_open_) found_.bounds.open.push_back(t);
  }

  const Found& found() const { return found_; }

 private:
  struct Entry {
    ConvexPiece piece;
    FacetRef hint;  ///< a facet that may be near to all of it
  };

  double limit() const { return found_.bounds.lower + gap_; }

  /// Takes a bound if it is low enough.
  bool accept(double bound) {
    if (bound > limit()) return false;
    found_.bounds.upper = std::max(found_.bounds.upper, bound);
    return true;
  }

  /// No point is farther from the nearest corner than by 1 / sqrt(3) of the longest side.
  bool is_bounded_by_corners(TriId t, const std::array<Vec3, 3>& p) {
    if (input_.vert_upper.empty()) return false;
    double upper = 0, longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      upper = std::max(upper, input_.vert_upper[input_.sampled.tris[t][k].index()]);
      longest = std::max(longest, distance(p[k], p[(k + 1) % 3]));
    }
    if (accept(upper + longest * std::numbers::inv_sqrt3 + own_error_)) return true;
    for (const VertId v : input_.sampled.tris[t])
      if (is_bounded_by(ConvexPiece(p), {input_.vert_nearest[v.index()]})) return true;
    return false;
  }

  bool is_bounded_by(const ConvexPiece& piece, const FacetRef& facet) {
    if (!facet.tri.is_valid()) return false;
    return accept(largest_distance(piece, finder_.data(facet)) + finder_.error(facet) + own_error_);
  }

  /// A sample that counts may raise the lower bound. Says whether it counts.
  bool see(const Vec3& p, double d, double error) {
    const double lower = d - error;
    if (!input_.counts && lower <= found_.bounds.lower) return true;
    if (input_.counts && !(*input_.counts)(p, d)) return false;
    if (lower > found_.bounds.lower) {
      found_.bounds.lower = lower;
      found_.bounds.worst = p;
    }
    return true;
  }

  static double largest_distance(const ConvexPiece& piece, const TriangleData& t) {
    double largest = 0;
    for (const Vec3& p : piece.verts())
      largest = std::max(largest, norm_sq(p - t.a - closest_offset(t, p - t.a)));
    return std::sqrt(largest);
  }

  void take(const Entry& entry) {
    const ConvexPiece& piece = entry.piece;
    if (is_bounded_by(piece, entry.hint)) return;
    const Vec3 c = piece.center();
    double radius = 0;
    for (const Vec3& p : piece.verts()) radius = std::max(radius, norm_sq(p - c));
    radius = std::sqrt(radius);
    const NearFacet near = finder_.find(c);
    const double error = near.error + own_error_;
    if (accept(near.distance + radius + error)) return;
    const TriangleData facet = finder_.data(near.ref);
    const double bound = std::min(near.distance + radius, largest_distance(piece, facet));
    if (accept(bound + error)) return;
    const bool is_seen = see(c, near.distance, error);
    if (!is_seen && radius <= input_.least_excused) return;
    if (accept(bound + error)) return;
    count_piece();
    const bool is_in_the_way = near.distance + error > limit();  // at the centre already
    const bool is_for_finer = input_.is_first && bound <= limit();
    if ((is_seen && is_in_the_way) || is_for_finer || radius <= kSliver * gap_)
      return give_up(bound + error, near.patch);
    if (is_seen)
      cut(piece, facet, near);
    else
      halve(piece, near.ref);
  }

  /// What facets bound well enough and their errors do not.
  void give_up(double bound, std::int32_t nearest) {
    found_.bounds.open_upper = std::max(found_.bounds.open_upper, bound);
    is_open_ = true;
    found_.bounds.coarse.push_back(nearest);
  }

  void count_piece() {
    if (++num_pieces_ <= budget_) return;
    num_pieces_ = 0;
    gap_ *= 2;
  }

  /// Cuts off what lies beyond the space over the nearest triangle; what is left is bounded by it,
  /// or parted between it and the triangle that is nearest to the worst corner.
  void cut(ConvexPiece piece, const TriangleData& t, const NearFacet& near) {
    const std::array<Vec3, 3> sides = {t.ab, t.ac - t.ab, -t.ac};
    const std::array<Vec3, 3> starts = {t.a, t.a + t.ab, t.a + t.ac};
    bool is_cut = false;
    for (std::size_t k = 0; k < 3 && !piece.is_full(); ++k) {
      const Vec3 inward = normalized(cross(t.normal, sides[k]));
      Values inside;
      double deepest = 0, farthest = 0;
      const auto verts = piece.verts();
      for (std::size_t i = 0; i < verts.size(); ++i) {
        inside[i] = dot(verts[i] - starts[k], inward);
        deepest = std::max(deepest, inside[i]);
        farthest = std::max(farthest, -inside[i]);
      }
      const double sliver = kSliver * gap_;
      if (farthest <= sliver || deepest <= sliver) continue;
      const auto parts = piece.split(std::span(inside.data(), verts.size()));
      if (parts[0].is_empty() || parts[1].is_empty()) continue;
      push(parts[1], {});
      piece = parts[0];
      is_cut = true;
    }
    if (accept(largest_distance(piece, t) + near.error + own_error_)) return;
    if (is_cut)
      push(piece, {});
    else
      part(piece, t, near.ref);
  }

  /// In two, where the nearest triangle and the one nearest to the worst corner are equally far.
  void part(const ConvexPiece& piece, const TriangleData& t, const FacetRef& nearest) {
    const auto verts = piece.verts();
    std::size_t worst = 0;
    double largest = -1;
    for (std::size_t i = 0; i < verts.size(); ++i) {
      const double d_sq = norm_sq(verts[i] - t.a - closest_offset(t, verts[i] - t.a));
      if (d_sq > largest) largest = d_sq, worst = i;
    }
    const NearFacet other = finder_.find(verts[worst]);
    see(verts[worst], other.distance, other.error + own_error_);
    const bool is_other = other.ref.tri != nearest.tri || other.ref.is_finer != nearest.is_finer;
    if (is_other && part_between(piece, {t, finder_.data(other.ref)}, worst, {nearest, other.ref}))
      return;
    halve(piece, nearest);
  }

  bool part_between(const ConvexPiece& piece, const std::array<TriangleData, 2>& t,
                    std::size_t worst, const std::array<FacetRef, 2>& refs) {
    const auto verts = piece.verts();
    const auto height = [](const TriangleData& of, const Vec3& p) {
      return dot(p - of.a, of.normal);
    };
    const double sign_a = height(t[0], verts[worst]) < 0 ? -1 : 1;
    const double sign_b = height(t[1], verts[worst]) < 0 ? -1 : 1;
    Values more;
    double highest = 0, lowest = 0;
    for (std::size_t i = 0; i < verts.size(); ++i) {
      more[i] = sign_a * height(t[0], verts[i]) - sign_b * height(t[1], verts[i]);
      highest = std::max(highest, more[i]);
      lowest = std::min(lowest, more[i]);
    }
    const double sliver = kSliver * gap_;
    if (piece.is_full() || highest <= sliver || lowest >= -sliver) return false;
    const auto parts = piece.split(std::span(more.data(), verts.size()));
    if (parts[0].is_empty() || parts[1].is_empty()) return false;
    push(parts[0], refs[1]);
    push(parts[1], refs[0]);
    return true;
  }

  /// Across its longest diagonal; a piece with many corners in triangles.
  void halve(const ConvexPiece& piece, const FacetRef& hint) {
    const auto verts = piece.verts();
    if (piece.is_full()) {
      for (std::size_t i = 2; i < verts.size(); ++i)
        push(ConvexPiece({verts[0], verts[i - 1], verts[i]}), hint);
      return;
    }
    Vec3 a = verts[0], b = verts[1];
    for (std::size_t i = 0; i < verts.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (norm_sq(verts[i] - verts[j]) > norm_sq(a - b)) a = verts[i], b = verts[j];
    Values beyond;
    for (std::size_t i = 0; i < verts.size(); ++i) beyond[i] = dot(verts[i] - 0.5 * (a + b), b - a);
    for (const ConvexPiece& half : piece.split(std::span(beyond.data(), verts.size())))
      push(half, hint);
  }

  void push(const ConvexPiece& piece, const FacetRef& hint) {
    if (!piece.is_empty()) stack_.push_back({piece, hint});
  }

  const BoundInput& input_;
  Found found_;
  double gap_;
  std::size_t budget_, num_pieces_ = 0;
  std::vector<Entry> stack_;
  FacetFinder finder_;
  double own_error_ = 0;
  bool is_open_ = false;
};

}  // namespace

DistanceBounds bound_distance(const BoundInput& input) {
  const bool is_all = input.tris.empty();
  const std::size_t count = is_all ? input.sampled.num_tris() : input.tris.size();
  Found init;
  init.bounds.lower = input.lower;
  init.bounds.worst = input.worst;
  Found total = parallel_reduce(
      count, init,
      [&](std::size_t begin, std::size_t end) {
        const double share = static_cast<double>(end - begin) / static_cast<double>(count);
        PieceBounder bounder(input, end - begin, share);
        for (std::size_t i = begin; i < end; ++i) bounder.bound(is_all ? TriId(i) : input.tris[i]);
        return bounder.found();
      },
      [](Found a, const Found& b) {
        a.take(b);
        return a;
      },
      kGrain);
  return std::move(total.bounds);
}

}  // namespace hexwright
