// Which way up: the attitude among the 24 of a cube that moments of the surface tell.
//
// What follows the lattice's axes (ties between cells, sweeps, the order of vertices) depends on
// how the part lies in it, and the loop of refinements amplifies that: the same part upright and
// lying would get different meshes.
#include <array>
#include <cmath>
#include <vector>

#include "hexwright/geometry/pose.h"

namespace hexwright {
namespace {

/// Keys that differ by less, relative to their largest possible value, are alike: sums over the
/// triangles of a turned surface run in another order.
constexpr double kAlike = 1e-9;

using Matrix = std::array<std::array<double, 3>, 3>;
using Tensor = std::array<Matrix, 3>;

/// Axis a of the turned frame is `sign[a]` times axis `axis[a]` of the given one.
struct AxisOrder {
  std::array<int, 3> axis = {0, 1, 2};
  std::array<int, 3> sign = {1, 1, 1};

  Rotation rotation() const {
    Rotation r;
    for (int a = 0; a < 3; ++a) {
      r.axes[a] = {};
      r.axes[a][axis[a]] = sign[a];
    }
    return r;
  }
};

/// The identity first.
std::vector<AxisOrder> all_axis_orders() {
  constexpr int kPermutations[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                       {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  std::vector<AxisOrder> orders;
  for (int p = 0; p < 6; ++p)
    for (int signs = 0; signs < 8; ++signs) {
      AxisOrder order;
      int handedness = p < 3 ? 1 : -1;
      for (int a = 0; a < 3; ++a) {
        order.axis[a] = kPermutations[p][a];
        order.sign[a] = (signs >> a) & 1 ? -1 : 1;
        handedness *= order.sign[a];
      }
      if (handedness > 0) orders.push_back(order);
    }
  return orders;
}

/// Sums over the surface, each divided by the largest value that it could have.
struct Moments {
  Vec3 extent;
  Tensor area{};   ///< of area, third order, about the centre of the box
  Matrix edges{};  ///< of the triangles' edges, second order: tells a cube's diagonals apart
  Tensor verts{};  ///< of the triangles' corners, third order
};

void add(Tensor& tensor, const Vec3& p, double weight) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) tensor[i][j][k] += weight * p[i] * p[j] * p[k];
}

void divide(Matrix& matrix, double by) {
  for (auto& row : matrix)
    for (double& value : row) value /= by;
}

void divide(Tensor& tensor, double by) {
  for (Matrix& matrix : tensor) divide(matrix, by);
}

Moments compute_moments(const TriMesh& surface, const Box3& box) {
  const Vec3 center = box.center();
  const double size = box.diagonal();
  Moments m;
  m.extent = box.extent() / size;
  double total_area = 0;
  for (TriId t : surface.tris.ids()) {
    std::array<Vec3, 3> c = surface.corners(t);
    for (Vec3& p : c) p = (p - center) / size;
    const double area = norm(cross(c[1] - c[0], c[2] - c[0]));
    total_area += area;
    add(m.area, (c[0] + c[1] + c[2]) / 3, area);
    for (int e = 0; e < 3; ++e) {
      const Vec3 edge = c[(e + 1) % 3] - c[e];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m.edges[i][j] += edge[i] * edge[j];
      add(m.verts, c[e], 1);
    }
  }
  divide(m.area, total_area);
  divide(m.edges, 3.0 * static_cast<double>(surface.num_tris()));
  divide(m.verts, 3.0 * static_cast<double>(surface.num_tris()));
  return m;
}

/// What the moments are in a turned frame, in the order in which they decide.
std::vector<double> key_of(const Moments& m, const AxisOrder& o) {
  std::vector<double> key;
  for (int a = 0; a < 3; ++a) key.push_back(m.extent[o.axis[a]]);
  const auto append = [&](const Tensor& tensor) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          key.push_back(o.sign[i] * o.sign[j] * o.sign[k] *
                        tensor[o.axis[i]][o.axis[j]][o.axis[k]]);
  };
  append(m.area);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      key.push_back(o.sign[i] * o.sign[j] * m.edges[o.axis[i]][o.axis[j]]);
  append(m.verts);
  return key;
}

bool is_greater(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kAlike) return a[i] > b[i];
  return false;
}

}  // namespace

Rotation find_canonical_turn(const TriMesh& surface) {
  const Box3 box = bounding_box(surface);
  if (surface.tris.empty() || !(box.diagonal() > 0)) return {};
  const Moments moments = compute_moments(surface, box);
  AxisOrder best;
  std::vector<double> best_key = key_of(moments, best);
  for (const AxisOrder& order : all_axis_orders()) {
    std::vector<double> key = key_of(moments, order);
    if (is_greater(key, best_key)) best = order, best_key = std::move(key);
  }
  // Which of the attitudes it is makes no difference in principle. Of five that were tried on 50
  // models, with the longest extent along x or z, this one had the best average.
  const auto laid = best.rotation().axes;
  return {{laid[1], laid[2], laid[0]}};
}

}  // namespace hexwright
