// Rows run on a body: who moves, who stays, and how they may move.
#include "relax/passes/pass.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "hexwright/quality/hex_quality.h"

#include "helpers.h"
#include "relax/state/fit_state.h"

namespace hexwright::relax {
namespace {

constexpr int kSide = 7;

/// A box of unit cubes, one vertex of which is not where it should be.
struct Dented {
  explicit Dented(const Vec3& way, VertId vert = at(3, 3, 3)) : v(vert), body(make_body()) {
    body.mesh.positions[v] += way;
    before = body.mesh.positions;
  }
  static VertId at(int x, int y, int z) { return VertId((z * (kSide + 1) + y) * (kSide + 1) + x); }
  static Body make_body() {
    HexMesh mesh = test::box_hex_mesh(kSide, kSide, kSide);
    VertToHex around(mesh);
    return {std::move(mesh), std::move(around)};
  }
  double least() const { return summarize_quality(body.mesh).min_scaled_jacobian; }

  VertId v;
  Body body;
  IdVector<VertId, Vec3> before;
};

constexpr Pass kMend = {
    .limit = 0.9, .max_rounds = 20, .rings = 1, .sweep = {.shape = {0.9, 1, 0}}, .sweeps = 3};

TEST(Pass, MendsWhatIsBadAndTouchesNothingElse) {
  Dented mesh({0.6, 0, 0});
  ASSERT_LT(mesh.least(), 0.8);
  for (VertId v : mesh.body.move.ids())
    if (v.index() % 2 == 1 && v != mesh.v) mesh.body.move[v] = MoveIn::Point;
  EXPECT_TRUE(run(kMend, mesh.body, {}));
  EXPECT_GE(mesh.least(), kMend.limit);
  for (VertId v : mesh.before.ids()) {
    const Vec3 d = mesh.before[v] - mesh.before[mesh.v];
    const bool is_near = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 2.7;
    if (is_near && mesh.body.move[v] == MoveIn::Space) continue;
    EXPECT_EQ(mesh.body.mesh.positions[v], mesh.before[v]);
  }
}

TEST(Pass, LeavesAMeshAloneThatHasNothingBad) {
  Dented mesh({0.05, 0, 0});
  EXPECT_TRUE(run(kMend, mesh.body, {}));
  EXPECT_EQ(mesh.body.mesh.positions, mesh.before);
}

TEST(Pass, SaysWhenItsRoundsWereNotEnough) {
  Dented mesh({0.6, 0, 0});
  for (MoveIn& move : mesh.body.move) move = MoveIn::Point;
  EXPECT_FALSE(run(kMend, mesh.body, {}));
  EXPECT_EQ(mesh.body.mesh.positions, mesh.before);
}

TEST(Pass, VerticesStayInTheirPlaneOrLine) {
  const VertId v = Dented::at(3, 3, 0);
  for (MoveIn move : {MoveIn::Plane, MoveIn::Line}) {
    Dented mesh({0.6, 0.3, 0}, v);
    const Vec3 axis = move == MoveIn::Plane ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    mesh.body.move[v] = move;
    mesh.body.axis[v] = axis;
    run(kMend, mesh.body, {});
    const Vec3 way = mesh.body.mesh.positions[v] - mesh.before[v];
    EXPECT_GT(norm(way), 0.1);
    EXPECT_EQ(way.z, 0);
    if (move == MoveIn::Line) {
      EXPECT_EQ(way.y, 0);
    }
  }
}

TEST(Pass, UntanglesWithLessAndLessRegularisation) {
  Dented mesh({1.3, 0.2, 0});
  ASSERT_LT(mesh.least(), 0);
  Pass pass = kMend;
  pass.limit = 0.05;
  Dented stuck = mesh;
  EXPECT_FALSE(run(pass, stuck.body, {}));  // a barrier cannot be crossed from outside
  pass.untangle = {0.3, 0.01, 0.7};
  EXPECT_TRUE(run(pass, mesh.body, {}));
  EXPECT_GE(mesh.least(), 0.05);
}

TEST(Pass, MovingVerticesWakeNoNeighbours) {
  for (Again again : {Again::Moving, Again::Dirty}) {
    Dented mesh({0.6, 0, 0});
    const std::vector<char> region = verts_of_poor_hexes(mesh.body, kMend.limit);
    for (char& dirty : mesh.body.is_dirty) dirty = 0;
    Pass pass = kMend;
    pass.max_rounds = 1;
    pass.rings = 0;
    pass.again = again;
    run(pass, mesh.body, {});
    EXPECT_GT(mesh.least(), 0.8);
    std::size_t num_woken = 0;
    for (VertId v : mesh.body.is_dirty.ids())
      num_woken += !region[v.index()] && mesh.body.is_dirty[v];
    if (again == Again::Moving)
      EXPECT_EQ(num_woken, 0u);
    else
      EXPECT_GT(num_woken, 0u);
  }
}

IdVector<HexId, double> weigh_first_only(const HexMesh& mesh) {
  IdVector<HexId, double> weight(mesh.num_hexes(), 0.0);
  weight[HexId(0)] = 1;
  return weight;
}

TEST(Pass, HexesCountByTheirWeights) {
  // Vertex (1,1,1) of the first hex serves eight hexes; weighed alone, the first gets its best.
  Dented equal({0.5, 0.5, 0.5}, Dented::at(1, 1, 1)), first({0.5, 0.5, 0.5}, Dented::at(1, 1, 1));
  Pass pass = kMend;
  pass.max_rounds = 1;
  pass.rings = 0;
  pass.limit = 0.99;
  run(pass, equal.body, {});
  pass.weigh = weigh_first_only;
  run(pass, first.body, {});
  EXPECT_NE(first.body.mesh.positions, equal.body.mesh.positions);
  EXPECT_GT(scaled_jacobian(first.body.mesh.corners(HexId(0))),
            scaled_jacobian(equal.body.mesh.corners(HexId(0))) + 0.1);
}

// One column of hexes, an object each but for the outside at the end: every border once.
TEST(FitState, QuadsLieBetweenAnyTwoRegions) {
  FitState state(test::box_hex_mesh(4, 1, 1));
  state.side = Side::Both;
  for (std::int32_t tag : {3, 1, 4, FitState::kOutsideRegion}) state.mesh.region.push_back(tag);
  for (VertId v : state.move.ids()) {  // the box's sides are no border
    const double x = state.mesh.positions[v].x;
    if (x == 0 || x == 4) state.move[v] = MoveIn::Point;
  }
  state.rebuild();
  std::vector<std::array<int, 2>> borders;  // hex and the x of the face's plane
  for (std::size_t q = 0; q < state.quads.size(); ++q) {
    const auto& p = state.mesh.positions;
    const double x = p[state.quads[q][0]].x;
    if (p[state.quads[q][1]].x == x && p[state.quads[q][2]].x == x)
      borders.push_back({state.quad_face[q].hex.value(), static_cast<int>(x)});
  }
  std::sort(borders.begin(), borders.end());
  EXPECT_EQ(borders, (std::vector<std::array<int, 2>>{{1, 1}, {1, 2}, {2, 3}}));
  EXPECT_EQ(state.inside_hexes(), (std::vector<char>{1, 1, 1, 0}));
}

TEST(Body, SizesAreMeanLengthsOfEdges) {
  Dented mesh({0, 0, 0});
  for (VertId v : mesh.body.size.ids()) EXPECT_EQ(mesh.body.size[v], 1);
  HexMesh stretched = test::box_hex_mesh(2, 2, 2);
  for (Vec3& p : stretched.positions) p.x *= 4;
  VertToHex around(stretched);
  const Body body(std::move(stretched), std::move(around));
  EXPECT_DOUBLE_EQ(body.size[VertId(13)], 2);  // the middle: 4, 1, 1
}

}  // namespace
}  // namespace hexwright::relax
