#include "relax/kernel/vertex_newton.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "helpers.h"

namespace hexwright {
namespace {

using namespace relax;

// A 2x2x2 block whose vertices are moved by up to `amount` of an edge.
HexMesh jittered_block(std::mt19937& rng, double amount) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  std::uniform_real_distribution<double> offset(-amount, amount);
  for (Vec3& p : mesh.positions) p += {offset(rng), offset(rng), offset(rng)};
  return mesh;
}

VertId centre() { return VertId(13); }

// The energy written down directly from its definition, corner by corner.
double energy_by_definition(const HexMesh& mesh, VertId v, const VertexGoal& goal,
                            const ShapeEnergy& shape) {
  double total = 0;
  for (const auto& hex : mesh.hexes) {
    for (std::size_t lv = 0; lv < 8; ++lv) {
      bool takes_part = hex[lv] == v;
      Vec3 e[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const VertId u = hex[static_cast<std::size_t>(kHexCornerNeighbors[lv][k])];
        takes_part = takes_part || u == v;
        e[k] = mesh.positions[u] - mesh.positions[hex[lv]];
      }
      if (!takes_part) continue;
      const double determinant = det(e[0], e[1], e[2]);
      const double d = shape.untangle == 0
                           ? determinant
                           : 0.5 * (determinant + std::hypot(determinant, shape.untangle));
      const double trace = norm_sq(e[0]) + norm_sq(e[1]) + norm_sq(e[2]);
      const double condition = trace * trace * trace / (27 * d * d);
      const double jacobian = norm_sq(e[0]) * norm_sq(e[1]) * norm_sq(e[2]) / (d * d);
      total += (1 - shape.blend) * std::pow(condition, shape.power) +
               shape.blend * std::pow(jacobian, shape.power);
    }
  }
  const Vec3 y = mesh.positions[v] - goal.target;
  const double along = dot(y, goal.direction);
  if (goal.attach == AttachTo::Plane) total += goal.weight * along * along;
  if (goal.attach == AttachTo::Line) total += goal.weight * (norm_sq(y) - along * along);
  if (goal.attach == AttachTo::Point) total += goal.weight * norm_sq(y);
  return total;
}

std::vector<ShapeEnergy> all_shapes() {
  return {{0, 1, 0}, {0.9, 1, 0}, {1, 1, 0}, {0, 3, 0}, {0.5, 4, 0}, {0.9, 1, 0.1}, {0, 2, 0.3}};
}

VertexGoal goal_of_kind(AttachTo attach) {
  VertexGoal goal;
  goal.attach = attach;
  goal.weight = 0.7;
  goal.target = {1.1, 0.8, 1.05};
  goal.direction = normalized(Vec3{1, 2, -0.5});
  goal.max_step = 1;
  return goal;
}

TEST(VertexNewton, EnergyAndGradientMatchTheDefinition) {
  std::mt19937 rng(7);
  VertexNewton newton;
  for (const ShapeEnergy& shape : all_shapes()) {
    for (AttachTo attach : {AttachTo::Nothing, AttachTo::Plane, AttachTo::Line, AttachTo::Point}) {
      HexMesh mesh = jittered_block(rng, 0.15);
      const VertexGoal goal = goal_of_kind(attach);
      const VertexStars stars(mesh);
      const IdSpan<VertId, const Vec3> at(mesh.positions);
      const auto got = newton.evaluate(centre(), stars[centre()], goal, shape, at);
      const double expected = energy_by_definition(mesh, centre(), goal, shape);
      EXPECT_NEAR(got.energy, expected, 1e-12 * expected);
      for (int axis = 0; axis < 3; ++axis) {
        const double step = 1e-5;
        HexMesh plus = mesh, minus = mesh;
        plus.positions[centre()][axis] += step;
        minus.positions[centre()][axis] -= step;
        const double slope = (energy_by_definition(plus, centre(), goal, shape) -
                              energy_by_definition(minus, centre(), goal, shape)) /
                             (2 * step);
        EXPECT_NEAR(got.gradient[axis], slope, 1e-6 * (expected + std::abs(slope)));
      }
    }
  }
}

// The condition term's Hessian is exact; the other drops only what could make it indefinite.
TEST(VertexNewton, HessianOfTheConditionTermIsExact) {
  std::mt19937 rng(11);
  VertexNewton newton;
  for (int power : {1, 3}) {
    HexMesh mesh = jittered_block(rng, 0.2);
    const VertexStars stars(mesh);
    const ShapeEnergy shape{0, power, 0};
    const auto at = [&](const HexMesh& m) {
      return newton.evaluate(centre(), stars[centre()], goal_of_kind(AttachTo::Line), shape,
                             IdSpan<VertId, const Vec3>(m.positions));
    };
    const auto here = at(mesh);
    const std::size_t slot[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    for (int axis = 0; axis < 3; ++axis) {
      HexMesh plus = mesh, minus = mesh;
      plus.positions[centre()][axis] += 1e-5;
      minus.positions[centre()][axis] -= 1e-5;
      const Vec3 row = (at(plus).gradient - at(minus).gradient) / 2e-5;
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(here.hessian[slot[axis][k]], row[k], 1e-5 * here.hessian[slot[axis][axis]]);
    }
  }
}

TEST(VertexNewton, StepsNeverInvertAndNeverRaiseTheEnergy) {
  std::mt19937 rng(3);
  VertexNewton newton;
  int moved = 0;
  for (int trial = 0; trial < 300; ++trial) {
    HexMesh mesh = jittered_block(rng, 0.25);
    const VertexStars stars(mesh);
    const IdSpan<VertId, const Vec3> at(mesh.positions);
    if (!(min_scaled_jacobian_around(mesh.positions[centre()], stars[centre()], at) > 0)) continue;
    VertexGoal goal = goal_of_kind(AttachTo::Point);
    goal.target = {4, -3, 2};  // far outside: the barrier has to hold
    goal.weight = std::pow(10.0, trial % 7);
    goal.relaxation = trial % 2 == 0 ? 1 : 1.6;
    const ShapeEnergy shape = all_shapes()[static_cast<std::size_t>(trial % 5)];
    for (int k = 0; k < 10; ++k) {
      const double before = energy_by_definition(mesh, centre(), goal, shape);
      moved += newton.solve(centre(), stars[centre()], goal, shape,
                            IdSpan<VertId, Vec3>(mesh.positions)) > 0;
      EXPECT_LE(energy_by_definition(mesh, centre(), goal, shape), before * (1 + 1e-12));
      EXPECT_GT(min_scaled_jacobian_around(mesh.positions[centre()], stars[centre()], at), 0);
    }
  }
  EXPECT_GT(moved, 300);
}

// Sweeps over a jittered block whose boundary stays come nearer to the cubes when over-relaxed.
TEST(VertexNewton, OverRelaxedSweepsConvergeFaster) {
  const auto miss_after_sweeps = [](double relaxation) {
    std::mt19937 rng(5);
    std::uniform_real_distribution<double> offset(-0.2, 0.2);
    HexMesh mesh = test::box_hex_mesh(8, 8, 8);
    const HexMesh cubes = mesh;
    const auto is_inside = [&](VertId v) {
      const Vec3& p = cubes.positions[v];
      return std::min({p.x, p.y, p.z}) > 0.5 && std::max({p.x, p.y, p.z}) < 7.5;
    };
    for (VertId v : mesh.positions.ids())
      if (is_inside(v)) mesh.positions[v] += {offset(rng), offset(rng), offset(rng)};
    const VertexStars stars(mesh);
    VertexNewton newton;
    VertexGoal goal;
    goal.max_step = 1;
    goal.relaxation = relaxation;
    for (int sweep = 0; sweep < 15; ++sweep)
      for (VertId v : mesh.positions.ids())
        if (is_inside(v)) newton.solve(v, stars[v], goal, {}, IdSpan<VertId, Vec3>(mesh.positions));
    double miss = 0;
    for (VertId v : mesh.positions.ids()) miss += norm_sq(mesh.positions[v] - cubes.positions[v]);
    return miss;
  };
  EXPECT_LT(miss_after_sweeps(1.4), 0.5 * miss_after_sweeps(1));
}

// Twice the weight is the same hex counted twice.
TEST(VertexNewton, WeighsHexes) {
  std::mt19937 rng(8);
  VertexNewton newton;
  for (const ShapeEnergy& shape : all_shapes()) {
    const HexMesh mesh = jittered_block(rng, 0.15);
    const VertexStars stars(mesh);
    const IdSpan<VertId, const Vec3> at(mesh.positions);
    const auto star = stars[centre()];
    std::vector<HexStar> repeated(star.begin(), star.end());
    repeated.insert(repeated.end(), {star[2], star[5], star[5]});
    VertexGoal goal;
    goal.max_step = 1;
    const auto expected = newton.evaluate(centre(), repeated, goal, shape, at);
    const std::vector<double> weights = {1, 1, 2, 1, 1, 3, 1, 1};
    goal.hex_weights = weights;
    const auto weighed = newton.evaluate(centre(), star, goal, shape, at);
    EXPECT_NEAR(weighed.energy, expected.energy, 1e-12 * expected.energy);
    EXPECT_LT(norm(weighed.gradient - expected.gradient), 1e-9 * (1 + norm(expected.gradient)));
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(weighed.hessian[k], expected.hessian[k], 1e-9 * expected.hessian[0]);
    HexMesh a = mesh, b = mesh;
    newton.solve(centre(), star, goal, shape, IdSpan<VertId, Vec3>(a.positions));
    goal.hex_weights = {};
    newton.solve(centre(), repeated, goal, shape, IdSpan<VertId, Vec3>(b.positions));
    EXPECT_LT(distance(a.positions[centre()], b.positions[centre()]), 1e-9);
  }
}

TEST(VertexNewton, RecoversTheCentreOfARegularBlock) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  mesh.positions[centre()] += {0.4, -0.3, 0.2};
  const VertexStars stars(mesh);
  VertexGoal goal;
  goal.max_step = 1;
  VertexNewton newton;
  for (int k = 0; k < 20; ++k)
    newton.solve(centre(), stars[centre()], goal, {}, IdSpan<VertId, Vec3>(mesh.positions));
  EXPECT_LT(distance(mesh.positions[centre()], {1, 1, 1}), 1e-9);
}

TEST(VertexNewton, UntanglesAnInvertedVertex) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  mesh.positions[centre()] = {2.4, 1.2, 0.9};  // beyond the block's side
  const VertexStars stars(mesh);
  const IdSpan<VertId, const Vec3> at(mesh.positions);
  ASSERT_LT(min_scaled_jacobian_around(mesh.positions[centre()], stars[centre()], at), 0);
  VertexGoal goal;
  goal.max_step = 1;
  VertexNewton newton;
  for (int k = 0; k < 50; ++k)
    newton.solve(centre(), stars[centre()], goal, {0, 1, 0.1},
                 IdSpan<VertId, Vec3>(mesh.positions));
  EXPECT_GT(min_scaled_jacobian_around(mesh.positions[centre()], stars[centre()], at), 0.5);
}

TEST(VertexNewton, KeepsToThePlaneOrLineItMayMoveIn) {
  std::mt19937 rng(5);
  const Vec3 axis = normalized(Vec3{0.3, -1, 0.7});
  for (MoveIn move : {MoveIn::Plane, MoveIn::Line, MoveIn::Point}) {
    HexMesh mesh = jittered_block(rng, 0.1);
    mesh.positions[centre()] += {0.3, 0.1, -0.2};
    const Vec3 start = mesh.positions[centre()];
    const VertexStars stars(mesh);
    VertexGoal goal;
    goal.max_step = 1;
    goal.move = move;
    goal.axis = axis;
    VertexNewton newton;
    double moved = 0;
    for (int k = 0; k < 10; ++k)
      moved += newton.solve(centre(), stars[centre()], goal, {0.5, 1, 0},
                            IdSpan<VertId, Vec3>(mesh.positions));
    const Vec3 d = mesh.positions[centre()] - start;
    if (move == MoveIn::Plane) {
      EXPECT_NEAR(dot(d, axis), 0, 1e-12);
    }
    if (move == MoveIn::Line) {
      EXPECT_NEAR(norm(cross(d, axis)), 0, 1e-12);
    }
    if (move == MoveIn::Point) {
      EXPECT_EQ(start, mesh.positions[centre()]);
    }
    EXPECT_EQ(moved > 0.01, move != MoveIn::Point);
  }
}

TEST(VertexColors, SeparateNeighboursAndCoverEveryUsedVertex) {
  HexMesh mesh = test::box_hex_mesh(5, 4, 3);
  mesh.positions.push_back({9, 9, 9});  // used by no hex
  const VertToHex vert_to_hex(mesh);
  const VertexColors colors(mesh, vert_to_hex);
  std::vector<int> color(mesh.num_verts(), -1);
  for (std::size_t c = 0; c < colors.num_colors(); ++c)
    for (VertId v : colors[c]) {
      EXPECT_EQ(color[v.index()], -1);
      color[v.index()] = static_cast<int>(c);
    }
  EXPECT_EQ(color.back(), -1);
  for (std::size_t v = 0; v + 1 < color.size(); ++v) EXPECT_GE(color[v], 0);
  for (const auto& hex : mesh.hexes) {
    std::set<int> seen;
    for (VertId v : hex) seen.insert(color[v.index()]);
    EXPECT_EQ(seen.size(), 8u);
  }
}

}  // namespace
}  // namespace hexwright
