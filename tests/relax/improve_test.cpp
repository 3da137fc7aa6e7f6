#include "hexwright/relax/improve.h"

#include <gtest/gtest.h>

#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/fit_helpers.h"
#include "relax/kernel/fixed_bound.h"

namespace hexwright {
namespace {

using namespace relax;

HexMesh jittered_box(int n, double amount, std::mt19937& rng, bool also_boundary) {
  HexMesh mesh = test::box_hex_mesh(n, n, n);
  std::uniform_real_distribution<double> offset(-amount, amount);
  for (Vec3& p : mesh.positions) {
    const bool inside = p.x > 0 && p.x < n && p.y > 0 && p.y < n && p.z > 0 && p.z < n;
    const Vec3 d{offset(rng), offset(rng), offset(rng)};
    if (inside || also_boundary) p += d;
  }
  return mesh;
}

TEST(Improve, NeverLowersTheLeastAndKeepsTheBoundary) {
  std::mt19937 rng(2);
  for (double amount : {0.05, 0.15, 0.25, 0.35}) {
    HexMesh mesh = jittered_box(5, amount, rng, true);
    const HexMesh before = mesh;
    const ImproveReport report = improve(mesh, {}, {});
    EXPECT_DOUBLE_EQ(report.min_before, summarize_quality(before).min_scaled_jacobian);
    EXPECT_DOUBLE_EQ(report.min_after, summarize_quality(mesh).min_scaled_jacobian);
    EXPECT_GE(report.min_after, report.min_before);
    EXPECT_LE(report.min_after, report.upper_bound + 1e-9);
    for (const HexFace& face : compute_hex_neighbors(before).boundary)
      for (VertId v : face_verts(before, face)) EXPECT_EQ(mesh.positions[v], before.positions[v]);
  }
}

TEST(Improve, MakesAJitteredBoxRegular) {
  std::mt19937 rng(9);
  HexMesh mesh = jittered_box(5, 0.25, rng, false);
  EXPECT_GT(improve(mesh, {}, {}).min_after, 0.99);
}

TEST(Improve, UntanglesWhatTheBoundaryAllows) {
  std::mt19937 rng(13);
  HexMesh mesh = jittered_box(4, 0.8, rng, false);
  ASSERT_GT(summarize_quality(mesh).num_inverted, 10u);
  const ImproveReport report = improve(mesh, {}, {});
  EXPECT_LT(report.min_before, 0);
  EXPECT_GT(report.min_after, 0.9);
}

// Pushing one boundary edge over makes a corner whose quality no interior vertex can mend.
TEST(Improve, ProvesThatTheBoundaryHoldsTheWorst) {
  HexMesh mesh = test::box_hex_mesh(4, 4, 4);
  mesh.positions[VertId(2 * 5 + 2)] += {0.35, 0.35, 0};  // in the bottom plane
  const ImproveReport report = improve(mesh, {}, {});
  EXPECT_LT(report.upper_bound, 0.95);
  EXPECT_GT(report.min_after, report.upper_bound - 0.05);
  EXPECT_TRUE(report.bounding_hex.is_valid());
}

TEST(Improve, BoundHoldsForRandomPlacements) {
  std::mt19937 rng(21);
  for (int trial = 0; trial < 20; ++trial) {
    const HexMesh mesh = jittered_box(2, 0.2, rng, true);
    const VertToHex vert_to_hex(mesh);
    IdVector<VertId, char> is_held(mesh.num_verts(), 1);
    is_held[VertId(13)] = 0;
    const double bound = relax::bound_quality(mesh, vert_to_hex, is_held).value;
    std::normal_distribution<double> offset(0, 0.3);
    for (int k = 0; k < 100; ++k) {
      HexMesh moved = mesh;
      moved.positions[VertId(13)] += {offset(rng), offset(rng), offset(rng)};
      EXPECT_LE(summarize_quality(moved).min_scaled_jacobian, bound + 1e-12);
    }
  }
}

TEST(Improve, SlidesTheBoundaryOnTheSurface) {
  const SurfaceTree sphere(test::welded(test::unit_sphere_surface(5)));
  // A cube's lattice inflated to a ball, with its boundary vertices shuffled along the sphere.
  HexMesh mesh = test::box_hex_mesh(6, 6, 6);
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  for (Vec3& p : mesh.positions) {
    p = (p - Vec3{3, 3, 3}) / 3.0;
    const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double blend = cube * cube;
    p = p * ((1 - blend) * 0.7 + (cube > 0 ? blend * cube / norm(p) : 0.0));
    if (cube > 0.99) p = normalized(p + Vec3{offset(rng), offset(rng), offset(rng)});
  }
  ImproveOptions options;
  const HexMesh before = mesh;
  const Target target = wrap_target(sphere.surface());
  options.slide_on = &target;
  const ImproveReport report = improve(mesh, options, {});
  EXPECT_GT(report.min_after, report.min_before + 0.01);
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary)
    for (VertId v : face_verts(mesh, face)) EXPECT_LT(sphere.distance(mesh.positions[v]), 2e-3);

  // The same in millimetres, far away: by the target's frame.
  const Vec3 shift{-3e4, 7e3, 1e5};
  const auto move = [&](const Vec3& p) { return p * 1000 + shift; };
  TriMesh moved_sphere = sphere.surface();
  for (Vec3& p : moved_sphere.positions) p = move(p);
  HexMesh moved = before;
  for (Vec3& p : moved.positions) p = move(p);
  const VertId held = face_verts(moved, compute_hex_neighbors(moved).boundary.front())[0];
  moved.labels.corners = {held};
  const Vec3 held_at = moved.positions[held];
  const Target moved_target = make_slide_target(moved_sphere);
  options.slide_on = &moved_target;
  const ImproveReport moved_report = improve(moved, options, {});
  EXPECT_GT(moved_report.min_after, report.min_before + 0.01);
  EXPECT_EQ(moved.positions[held], held_at);  // to the bit: it did not go to the frame and back
  const SurfaceTree moved_tree(moved_sphere);
  for (const HexFace& face : compute_hex_neighbors(moved).boundary)
    for (VertId v : face_verts(moved, face)) EXPECT_LT(moved_tree.distance(moved.positions[v]), 2);
}

TEST(Improve, RejectsBrokenIndices) {
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.hexes[HexId(0)][3] = VertId(99);
  EXPECT_THROW(improve(mesh, {}, {}), Error);
}

TEST(Improve, RaisesPublishedMeshes) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  HexMesh mesh = read_hex_mesh(test::shared_dir() / "data/hex/hybridoctree_bone.vtk");
  const ImproveReport report = improve(mesh, {}, {});
  EXPECT_GT(report.min_after, report.min_before);
  EXPECT_GT(report.avg_after, report.avg_before);
}

}  // namespace
}  // namespace hexwright
