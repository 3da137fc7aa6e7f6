// Adaptive grids of any size for benchmarks, written leaf by leaf in Morton order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "hexwright/grid/grid.h"

namespace hexwright::bench {

enum class Shape { Sphere, Gyroid, Points };

/// Decides which nodes of the unit cube are split: those that a shape passes through.
class ShapeTest {
 public:
  ShapeTest(Shape shape, int depth) : shape_(shape) {
    if (shape != Shape::Points) return;
    // As many points as make grids of a size like the surfaces': 4^depth / 8.
    std::mt19937_64 rng(depth);
    points_.resize(std::size_t{1} << (2 * depth - 3));
    for (auto& p : points_) p = rng() >> (64 - 3 * kPointBits);
    std::sort(points_.begin(), points_.end());
  }

  /// Node of a depth; `key` is its Morton key.
  bool is_split(const LatticeCoord& node, int depth, std::uint64_t key) const {
    if (depth < 2) return true;
    if (shape_ == Shape::Points) {
      const int shift = 3 * (kPointBits - depth);
      const auto first = std::lower_bound(points_.begin(), points_.end(), key << shift);
      return first != points_.end() && *first >> shift == key;
    }
    const double h = 1.0 / (1 << depth);
    const double x = (node[0] + 0.5) * h, y = (node[1] + 0.5) * h, z = (node[2] + 0.5) * h;
    return std::abs(shape_ == Shape::Sphere ? sphere(x, y, z) : gyroid(x, y, z)) < 0.87 * h;
  }

 private:
  static constexpr int kPointBits = 20;
  static double sphere(double x, double y, double z) {
    return std::sqrt((x - .5) * (x - .5) + (y - .5) * (y - .5) + (z - .5) * (z - .5)) - 0.41;
  }
  /// About the distance to a gyroid of two periods, cut off near the cube's sides.
  static double gyroid(double x, double y, double z) {
    constexpr double kW = 4 * 3.14159265358979;
    const double g = std::sin(kW * x) * std::cos(kW * y) + std::sin(kW * y) * std::cos(kW * z) +
                     std::sin(kW * z) * std::cos(kW * x);
    return g / (1.5 * kW);
  }

  Shape shape_;
  std::vector<std::uint64_t> points_;  ///< sorted Morton keys
};

/// One root cube, split down to `depth` wherever the shape passes.
inline Grid make_shape_grid(Shape shape, int depth) {
  const ShapeTest test(shape, depth);
  Grid grid;
  grid.roots = {{0, 0, 0}};
  grid.finest_level = depth;
  const auto visit = [&](const auto& self, const LatticeCoord& node, int level,
                         std::uint64_t key) -> void {
    if (level < depth && test.is_split(node, level, key)) {
      for (int q = 0; q < 8; ++q)
        self(self, {2 * node[0] + (q & 1), 2 * node[1] + (q >> 1 & 1), 2 * node[2] + (q >> 2)},
             level + 1, 8 * key + static_cast<unsigned>(q));
      return;
    }
    GridCell cell;
    for (int a = 0; a < 3; ++a) cell.corner[a] = node[a] * (1 << (depth - level));
    cell.level = static_cast<std::int8_t>(level);
    grid.cells.push_back(cell);
  };
  visit(visit, {0, 0, 0}, 0, 0);
  grid.cells.raw().shrink_to_fit();
  return grid;
}

}  // namespace hexwright::bench
