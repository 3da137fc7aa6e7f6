// A pattern search per vertex: relaxing a staircase does not care whether its vertices stay
// visible, and at saddles a small step decides.
#include "fit/sheets/visible.h"

#include <algorithm>

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr double kEnough = 0.1;          // cosine to stop at
constexpr double kFirstStep = 0.4;       // of the vertex's size
constexpr int kHalvings = 4;             // of the step
constexpr double kLeastJacobian = 0.02;  // scaled, of hexes around, where they were no worse

struct SheetCorner {
  std::size_t quad, k;
};

/// Per sheet vertex: its place in the sheet's quads, in their order.
std::vector<std::vector<SheetCorner>> collect_corners(const Sheet& sheet) {
  std::vector<std::vector<SheetCorner>> corners(sheet.verts.size());
  for (std::size_t q = 0; q < sheet.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k)
      corners[sheet.index_of(sheet.quads[q][k])].push_back({q, k});
  return corners;
}

Vec3 corner_normal(const HexMesh& mesh, const Sheet& sheet, const SheetCorner& corner) {
  const auto& quad = sheet.quads[corner.quad];
  const Vec3& o = mesh.positions[quad[corner.k]];
  const Vec3 a = mesh.positions[quad[(corner.k + 1) % 4]] - o;
  const Vec3 b = mesh.positions[quad[(corner.k + 3) % 4]] - o;
  return normalized(cross(a, b));
}

class VisibleMover {
 public:
  VisibleMover(FitState& state, const Sheet& sheet)
      : state_(state), sheet_(sheet), corners_(collect_corners(sheet)) {}

  void run(std::span<const VertId> verts, double least_cosine) {
    for (VertId v : verts) {
      const std::size_t i = sheet_.index_of(v);
      if (state_.move[v] == MoveIn::Space && cosine(i) < least_cosine) improve(i);
    }
  }

 private:
  double cosine(std::size_t i) {
    normals_.clear();
    for (const SheetCorner& corner : corners_[i])
      normals_.push_back(corner_normal(state_.mesh, sheet_, corner));
    return find_visible_direction(normals_, kEnough).cosine;
  }

  /// The sheet's vertices in the faces at vertex i, and how well they are seen.
  std::vector<std::pair<std::size_t, double>> measure_neighbors(std::size_t i) {
    std::vector<std::pair<std::size_t, double>> result;
    for (const SheetCorner& corner : corners_[i])
      for (std::size_t step : {1, 3}) {
        const std::size_t j = sheet_.index_of(sheet_.quads[corner.quad][(corner.k + step) % 4]);
        const auto is_same = [&](const auto& known) { return known.first == j; };
        if (std::none_of(result.begin(), result.end(), is_same)) result.push_back({j, cosine(j)});
      }
    return result;
  }

  double jacobian_around(VertId v, const Vec3& p) const {
    return min_scaled_jacobian_around(p, state_.stars[v],
                                      IdSpan<VertId, const Vec3>(state_.mesh.positions));
  }

  void improve(std::size_t i) {
    const VertId v = sheet_.verts[i];
    const auto neighbors = measure_neighbors(i);
    const double least_jacobian =
        std::min(kLeastJacobian, jacobian_around(v, state_.mesh.positions[v]));
    double best = cosine(i);
    double step = kFirstStep * state_.size[v];
    for (int halving = 0; halving < kHalvings && best < kEnough;) {
      const Vec3 from = state_.mesh.positions[v];
      Vec3 to = from;
      for (int d = 0; d < 27; ++d) {
        if (d == 13) continue;  // no move
        const int x = d % 3, y = d / 3 % 3, z = d / 9;
        const Vec3 p = from + normalized(Vec3{x - 1.0, y - 1.0, z - 1.0}) * step;
        state_.mesh.positions[v] = p;
        const double seen = cosine(i);
        if (seen <= best || jacobian_around(v, p) < least_jacobian) continue;
        const bool is_harmless = std::all_of(neighbors.begin(), neighbors.end(), [&](auto& n) {
          return cosine(n.first) >= std::min(n.second, kEnough);
        });
        if (!is_harmless) continue;
        best = seen;
        to = p;
      }
      state_.mesh.positions[v] = to;
      if (to != from) continue;
      step *= 0.5;
      ++halving;
    }
    state_.is_dirty[v] = 1;
  }

  FitState& state_;
  const Sheet& sheet_;
  std::vector<std::vector<SheetCorner>> corners_;
  std::vector<Vec3> normals_;
};

}  // namespace

std::vector<VisibleDirection> find_visible_directions(const HexMesh& mesh, const Sheet& sheet) {
  std::vector<VisibleDirection> directions;
  std::vector<Vec3> normals;
  for (const auto& corners : collect_corners(sheet)) {
    normals.clear();
    for (const SheetCorner& corner : corners) normals.push_back(corner_normal(mesh, sheet, corner));
    directions.push_back(find_visible_direction(normals));
  }
  return directions;
}

void make_visible(FitState& state, const Sheet& sheet, std::span<const VertId> verts,
                  double least_cosine) {
  VisibleMover(state, sheet).run(verts, least_cosine);
}

}  // namespace hexwright::fitting
