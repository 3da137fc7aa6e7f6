// The sheet's inner vertices are pulled to their heights like the boundary of a fit to its surface:
// weights rise, shapes are a barrier. The sheet itself is relaxed by scaled Jacobians alone, which
// are indifferent to how thin it is; the inside by its shapes.
#include "layers/grow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "layers/displace.h"
#include "layers/heights.h"
#include "layers/hold.h"
#include "mesh/quad.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::layers {
namespace {

using namespace relax;

constexpr ShapeEnergy kSheetShape = {1, 1, 0}, kInsideShape = {0.2, 1, 0};
constexpr double kTolerance = 0.02;
constexpr int kInsideSweeps = 2;
constexpr int kNumPushes = 3;
constexpr double kReached = 0.5;      // of a height
constexpr double kLeastShare = 0.05;  // ... that is asked for still
constexpr double kHeld = 0.7;         // of the way along an edge whose other end stays
constexpr double kLow = 0.35;         // hexes of a lower scaled Jacobian are worked on
constexpr int kMaxPolishings = 8;
constexpr int kPolishPower = 3, kPolishSweeps = 4;
constexpr double kHoldWeight = 1e4;
constexpr double kPoor = 0.05;  // layers of a lower scaled Jacobian are made thinner
constexpr double kThinner = 0.75;
constexpr int kMaxThinnings = 8;
constexpr double kShort = 0.95;  // of the wished height: less has a reason
constexpr int kAverageRings = 3;

class Grower {
 public:
  Grower(SheetMesh& sheet, const Target& target, const LayersOptions& options,
         const Context& context)
      : sheet_(sheet),
        target_(target),
        options_(options),
        context_(context),
        state_(sheet.mesh),
        neighbors_(find_sheet_neighbors(sheet)),
        is_sheet_(state_.num_verts(), 0),
        is_inside_(state_.num_verts(), 1) {}

  /// Vertices of walls at layers that are not positive in the end.
  std::vector<VertId> run() {
    slides_ = hold_boundary(state_);
    for (const SheetVert& vert : sheet_.verts) fix(vert.wall);
    keep_offsets();
    place_sheet();
    limit_held_rims();
    push();
    grow({3, 10, 30, 100, 300}, 4);
    relent();
    grow({300, 1000}, 2);
    relent();
    polish();
    mend();
    settle_sliding();
    smooth_inside();
    copy_back();
    const std::vector<VertId> inverted = thin_until_valid();
    find_reasons();
    return inverted;
  }

 private:
  void fix(VertId v) {
    state_.kind[v] = VertKind::Interior;
    state_.move[v] = MoveIn::Point;
    slides_[v] = 0;
  }

  /// Vertices of curved patches stay as far beside the surface as the fit put them: their quads err
  /// to both sides of it.
  void keep_offsets() {
    IdVector<VertId, Vec3> normals(state_.num_verts());
    for (const auto& quad : state_.quads)
      for (VertId v : quad) normals[v] += quad_normal(state_.mesh.positions, quad);
    parallel_for(
        state_.num_verts(),
        [&](std::size_t i) {
          const VertId v(i);
          if (!slides_[v]) return;
          const Vec3& p = state_.mesh.positions[v];
          const auto nearest = target_.tree.closest(p);
          if (nearest) state_.offset[v] = dot(p - nearest->point, normalized(normals[v]));
        },
        64);
  }

  /// Inner vertices of the sheet: attached to planes, lines or points over the wall.
  void place_sheet() {
    for (const SheetVert& vert : sheet_.verts) {
      const VertId v = vert.inner;
      is_sheet_[v.index()] = 1;
      if (vert.is_rim) place_rim(vert);
      state_.kind[v] = vert.normals.size() == 1   ? VertKind::Surface
                       : vert.normals.size() == 2 ? VertKind::Curve
                                                  : VertKind::Corner;
      state_.direction[v] = vert.normals.size() == 2
                                ? normalized(cross(vert.normals[0], vert.normals[1]))
                                : vert.normals[0];
      slides_[v] = 0;
    }
    for (VertId v : state_.kind.ids())
      is_inside_[v.index()] = !is_sheet_[v.index()] && state_.move[v] != MoveIn::Point;
    aim();
  }

  /// Where a sheet ends on a curved patch or along a bent edge it goes straight on, and is brought
  /// back to the surface in the end.
  void place_rim(const SheetVert& vert) {
    const VertId v = vert.inner;
    const bool is_held = state_.move[v] == MoveIn::Plane || state_.move[v] == MoveIn::Line;
    if (is_held) return;
    is_bent_rim_.push_back(v);
    state_.move[v] = MoveIn::Line;
    state_.axis[v] = normalized(vert.offset);
  }

  void aim() {
    for (const SheetVert& vert : sheet_.verts) {
      const VertId v = vert.inner;
      const Vec3 from = state_.mesh.positions[vert.wall];
      state_.target[v] = vert.normals.size() == 1 ? from + vert.normals[0] * vert.height
                                                  : from + vert.offset * vert.height;
      state_.size[v] = std::min(vert.size, 2 * vert.height);
      state_.is_dirty[v] = 1;
    }
  }

  /// The next vertex along the rim's patch stays where it is.
  void limit_held_rims() {
    for (SheetVert& vert : sheet_.verts) {
      if (!vert.is_rim) continue;
      const Vec3 along = normalized(vert.offset);
      for (const HexStar& star : state_.stars[vert.inner])
        for (std::size_t k = 0; k < 3; ++k) {
          const VertId next = star[k];
          if (next == vert.wall || is_sheet_[next.index()]) continue;
          const Vec3 way = state_.mesh.positions[next] - state_.mesh.positions[vert.wall];
          if (state_.move[next] != MoveIn::Point || dot(way, along) < 0.8 * norm(way)) continue;
          const double limit = kHeld * norm(way) / std::max(1.0, norm(vert.offset));
          if (limit >= vert.height) continue;
          vert.height = limit;
          vert.limit = LayerLimit::Size;
        }
    }
    smooth_from_below(sheet_, neighbors_);
    aim();
  }

  /// Towards the heights with everything behind, before the barrier sets in.
  void push() {
    for (int step = 0; step < kNumPushes; ++step) {
      context_.check_cancelled();
      IdVector<VertId, Vec3> way(state_.num_verts());
      for (const SheetVert& vert : sheet_.verts) {
        const auto& p = state_.mesh.positions;
        way[vert.inner] = p[vert.wall] + vert.offset * vert.height - p[vert.inner];
      }
      displace(state_, is_sheet_, std::move(way));
      const LocalSweep inside(state_, is_inside_);
      inside.run(state_, {kInsideShape, 1, kTolerance});
    }
  }

  void grow(const std::vector<double>& weights, int rounds) {
    const LocalSweep sheet(state_, is_sheet_), inside(state_, is_inside_);
    for (double weight : weights)
      for (int round = 0; round < rounds; ++round) {
        context_.check_cancelled();
        for (const SheetVert& vert : sheet_.verts) state_.is_dirty[vert.inner] = 1;
        update_sliding();
        sheet.run_dirty(state_, {kSheetShape, weight, kTolerance});
        for (int s = 0; s < kInsideSweeps; ++s)
          inside.run_dirty(state_, {kInsideShape, weight, kTolerance});
      }
  }

  /// Around hexes that are poor, with energies that the poorest corners dominate; the best
  /// positions stay.
  void polish() {
    auto best = state_.mesh.positions;
    double best_least = -1;
    for (int round = 0;; ++round) {
      context_.check_cancelled();
      const auto quality = compute_scaled_jacobians(state_.mesh);
      const double least = *std::min_element(quality.begin(), quality.end());

      if (least > best_least) {
        best_least = least;
        best = state_.mesh.positions;
      }
      if (least >= kLow || round == kMaxPolishings) break;
      polish_once(quality, kPolishPower << round / 2);
    }
    state_.mesh.positions = std::move(best);
    state_.mark_all_dirty();
  }

  void polish_once(const IdVector<HexId, double>& quality, int power) {
    std::vector<char> region = verts_of_hexes(state_, [&](HexId h) { return quality[h] < kLow; });
    grow_vert_set(state_, region, 1);
    for (std::size_t i = 0; i < region.size(); ++i) region[i] &= is_sheet_[i] | is_inside_[i];
    update_sliding();
    const LocalSweep local(state_, region);
    SweepOptions options{{1, power, 0}, kHoldWeight, kTolerance};
    options.edge_floor = kEdgeFloor;
    for (int s = 0; s < kPolishSweeps; ++s) local.run(state_, options);
  }

  /// Heights that are out of reach are asked for no longer: the pull would only press hexes flat.
  void relent() {
    sheet_.mesh.positions = state_.mesh.positions;
    for (SheetVert& vert : sheet_.verts) {
      const double reached = measure_height(sheet_, vert);
      if (reached >= kReached * vert.height) continue;
      vert.height = std::max(reached, kLeastShare * vert.height);
      vert.limit = LayerLimit::Shape;
    }
    aim();
  }

  void update_sliding() {
    if (std::find(slides_.begin(), slides_.end(), 1) != slides_.end())
      update_targets(state_, {target_.tree}, 0, slides_.raw());
  }

  /// Makes the sheet thinner where its layers would be poor.
  void mend() {
    for (int round = 0; round < kMaxThinnings; ++round) {
      sheet_.mesh.positions = state_.mesh.positions;
      if (!thin_poor()) return;
      smooth_from_below(sheet_, neighbors_);
      aim();
      grow({30, 300}, 1);
    }
  }

  std::vector<double> measure_quality() const {
    std::vector<double> quality(sheet_.hexes.size());
    parallel_for(
        quality.size(),
        [&](std::size_t i) { quality[i] = layer_quality(sheet_, sheet_.hexes[i], options_); }, 64);
    return quality;
  }

  bool thin_poor() {
    const std::vector<double> quality = measure_quality();
    std::vector<char> is_poor(state_.num_verts(), 0);
    for (std::size_t i = 0; i < quality.size(); ++i)
      if (quality[i] < kPoor)
        for (std::size_t k = 0; k < 4; ++k)
          is_poor[sheet_.mesh.hexes[sheet_.hexes[i].hex][k].index()] = 1;
    bool any = false;
    for (SheetVert& vert : sheet_.verts) {
      if (!is_poor[vert.inner.index()]) continue;
      vert.height = kThinner * std::min(vert.height,
                                        std::max(0.1 * vert.height, measure_height(sheet_, vert)));
      vert.limit = LayerLimit::Shape;
      any = true;
    }
    return any;
  }

  /// Vertices of curved patches, back onto them.
  void settle_sliding() {
    std::vector<char> only = slides_.raw();
    for (VertId v : is_bent_rim_) {
      only[v.index()] = 1;
      state_.kind[v] = VertKind::Surface;
      state_.move[v] = MoveIn::Space;
      state_.query[v] = {};
    }
    if (std::find(only.begin(), only.end(), 1) == only.end()) return;
    snap_to_targets(state_, {target_.tree}, 0.1, only);
  }

  /// The average of the inside near the sheet, whose vertices stay.
  void smooth_inside() {
    for (const SheetVert& vert : sheet_.verts) state_.move[vert.inner] = MoveIn::Point;
    for (VertId v : state_.kind.ids())
      if (slides_[v]) state_.move[v] = MoveIn::Point;
    const auto quality = compute_scaled_jacobians(state_.mesh);
    AverageOptions average;
    average.floor = *std::min_element(quality.begin(), quality.end());
    std::vector<char> near = is_sheet_;
    grow_vert_set(state_, near, kAverageRings);
    for (VertId v : state_.kind.ids()) state_.is_dirty[v] = near[v.index()];
    sweep_for_average(state_, average.floor, average, context_);
  }

  void copy_back() { sheet_.mesh.positions = state_.mesh.positions; }

  /// The last word: straight towards the wall until all layers are positive, as those are whose
  /// hex becomes a prism over its wall quad. Where neighbours that stay forbid that: the wall's
  /// vertices there.
  std::vector<VertId> thin_until_valid() {
    constexpr int kMaxHalvings = 40;
    for (int round = 0;; ++round) {
      const std::vector<double> quality = measure_quality();
      std::vector<char> is_bad(state_.num_verts(), 0);
      bool any = false;
      for (std::size_t i = 0; i < quality.size(); ++i) {
        if (quality[i] > 0) continue;
        any = true;
        for (std::size_t k = 0; k < 4; ++k)
          is_bad[sheet_.mesh.hexes[sheet_.hexes[i].hex][k].index()] = 1;
      }
      if (!any) return {};
      if (round == kMaxHalvings) return walls_under(is_bad);
      for (SheetVert& vert : sheet_.verts)
        if (is_bad[vert.inner.index()]) halve(vert);
    }
  }

  std::vector<VertId> walls_under(const std::vector<char>& is_inner) const {
    std::vector<VertId> walls;
    for (const SheetVert& vert : sheet_.verts)
      if (is_inner[vert.inner.index()]) walls.push_back(vert.wall);
    return walls;
  }

  void halve(SheetVert& vert) {
    auto& p = sheet_.mesh.positions;
    const Vec3 half = (p[vert.wall] + p[vert.inner]) * 0.5;
    vert.limit = LayerLimit::Shape;
    if (min_scaled_jacobian_around(half, state_.stars[vert.inner], IdSpan<VertId, const Vec3>(p)) >
        0)
      p[vert.inner] = half;
  }

  void find_reasons() {
    for (SheetVert& vert : sheet_.verts)
      if (vert.limit == LayerLimit::None && measure_height(sheet_, vert) < kShort * vert.wish)
        vert.limit = LayerLimit::Shape;
  }

  SheetMesh& sheet_;
  const Target& target_;
  const LayersOptions& options_;
  const Context& context_;
  FitState state_;
  std::vector<std::vector<std::size_t>> neighbors_;
  std::vector<char> is_sheet_, is_inside_;  // per vertex
  IdVector<VertId, char> slides_;           // on a curved patch
  std::vector<VertId> is_bent_rim_;
};

}  // namespace

double measure_height(const SheetMesh& sheet, const SheetVert& vert) {
  const Vec3 way = sheet.mesh.positions[vert.inner] - sheet.mesh.positions[vert.wall];
  if (vert.is_convex) return norm(way) / norm(vert.offset);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& n : vert.normals) least = std::min(least, dot(n, way));
  return std::max(0.0, least);
}

double layer_quality(const SheetMesh& sheet, const SheetHex& hex, const LayersOptions& options) {
  const LayerSpec& spec = options.specs[static_cast<std::size_t>(hex.spec)];
  const std::array<Vec3, 8> p = sheet.mesh.corners(hex.hex);
  std::array<Vec3, 8> part;
  double least = 1;
  for (int layer = 0; layer < spec.count; ++layer) {
    const double low = spec.share_of(layer), high = spec.share_of(layer + 1);
    for (std::size_t k = 0; k < 4; ++k) {
      part[k + 4] = p[k + 4] + (p[k] - p[k + 4]) * low;
      part[k] = p[k + 4] + (p[k] - p[k + 4]) * high;
    }
    least = std::min(least, scaled_jacobian(part));
  }
  return least;
}

std::vector<VertId> grow_sheet(SheetMesh& sheet, const Target& target, const LayersOptions& options,
                               const Context& context) {
  return Grower(sheet, target, options, context).run();
}

}  // namespace hexwright::layers
