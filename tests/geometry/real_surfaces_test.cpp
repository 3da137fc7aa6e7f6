// Preparation and queries on files as they are found: bundled ones, and the shared collection where
// it is present.
#include <algorithm>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/surface_topology.h"
#include "hexwright/io/surface_io.h"

#include "geometry/random_soup.h"
#include "helpers.h"

namespace hexwright {
namespace {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(RealSurfaces, BundledModelsAreClosedAndAnswerQueriesAsBruteForceDoes) {
  for (const auto& file : files_in(test::bundled("models"))) {
    const SurfaceTree tree(prepare_surface(read_surface(file).mesh, {}).mesh);
    const TriMesh& surface = tree.surface();
    EXPECT_TRUE(compute_topology(surface).is_closed_manifold()) << file;
    std::mt19937_64 random(37);
    const double half = tree.box().diagonal() / 2;
    for (int i = 0; i < 30; ++i) {
      const Vec3 p = tree.box().center() + test::random_point(random, 1.1) * half;
      double expected = std::numeric_limits<double>::infinity();
      for (TriId t : surface.tris.ids())
        expected = std::min(expected, test::brute_distance(p, surface.corners(t)));
      EXPECT_NEAR(tree.distance(p), expected, 1e-9 * half) << file;
      EXPECT_NEAR(tree.winding_number(p), test::brute_winding(surface, p), 0.08) << file;
      EXPECT_EQ(tree.is_inside(p), test::brute_winding(surface, p) > 0.5) << file;
    }
  }
}

TEST(RealSurfaces, BundledCubeHasItsFeatures) {
  const auto cube =
      prepare_surface(read_surface(test::bundled("models/cube_minus_sphere.obj")).mesh, {});
  const auto features = extract_features(cube.mesh, {});
  // Twelve edges of the cube, three of them cut short by the sphere, whose rim is three arcs.
  EXPECT_EQ(features.curves.size(), 15u);
  EXPECT_EQ(features.corners.size(), 10u);
  EXPECT_EQ(compute_patches(cube.mesh, features)[TriId(0)], PatchId(0));
}

/// What becomes of a file that parses.
struct Outcome {
  const char* name;
  bool is_closed;
  std::size_t num_components;
  long euler_characteristic;
};

const Outcome kAccepted[] = {
    {"degenerate_triangles.obj", true, 1, -2},
    {"denormal_coordinates.obj", true, 1, -2},
    {"disconnected_pieces.obj", true, 4, 0},
    {"duplicate_faces.obj", true, 1, -2},
    {"far_from_origin.obj", true, 1, -2},
    {"flipped_all.obj", true, 1, -2},
    {"flipped_half.obj", true, 1, -2},
    {"huge_coordinates.obj", true, 1, -2},
    {"internal_fin.obj", true, 1, 2},
    {"natural_Cray_left.obj", true, 2, 4},
    {"natural_degenerate_wave.obj", true, 1, 2},
    {"natural_flipped_head.obj", true, 1, 2},
    {"natural_inconsistent_bottle1.obj", true, 1, 0},
    {"natural_multi_box.STL", true, 1, -100},
    {"natural_open_mannequin-devil.off", true, 1, 2},
    {"natural_open_teapot.obj", true, 1, 0},
    {"natural_two_spheres.obj", true, 1, 2},
    {"nearly_welded_soup.obj", true, 1, -2},
    {"needle.obj", true, 1, 2},
    {"nested_cavity.obj", true, 2, 4},
    {"nested_same_orientation.obj", true, 1, 2},
    {"nonmanifold_edge.obj", true, 2, 4},
    {"nonmanifold_edge_welded.obj", true, 2, 4},
    {"open_cube_no_top.obj", true, 1, 2},
    {"overflow_coordinates.obj", true, 1, -2},
    {"overlapping_cubes.obj", true, 1, 2},
    {"thin_gap.obj", true, 2, 4},
    {"thin_sheet.obj", true, 1, 2},
    {"tiny_coordinates.obj", true, 1, -2},
    {"touching_cubes_face.obj", true, 1, 2},
    {"unreferenced_vertices.obj", true, 1, -2},
    {"unwelded_soup.obj", true, 1, -2},
};

TEST(RealSurfaces, RepairableFilesComeOutAsExpected) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const Outcome& expected : kAccepted) {
    SCOPED_TRACE(expected.name);
    const auto file = test::shared_dir() / "data/bad" / expected.name;
    const auto prepared = prepare_surface(read_surface(file).mesh, {});
    const auto topology = compute_topology(prepared.mesh);
    EXPECT_EQ(prepared.diagnosis.is_closed, expected.is_closed);
    EXPECT_EQ(topology.num_components, expected.num_components);
    EXPECT_EQ(topology.euler_characteristic, expected.euler_characteristic);
  }
}

TEST(RealSurfaces, EveryBadFileIsPreparedOrRefusedWithARemedy) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const auto& file : files_in(test::shared_dir() / "data/bad")) {
    try {
      const auto prepared = prepare_surface(read_surface(file).mesh, {});
      EXPECT_FALSE(prepared.mesh.find_problem()) << file;
      EXPECT_GT(prepared.mesh.num_tris(), 0u) << file;
    } catch (const Error& e) {
      EXPECT_GT(std::string(e.what()).size(), 30u) << file;
    }
  }
  for (const char* name :
       {"all_degenerate.obj", "flat_double_sided.obj", "natural_soup.stl", "single_triangle.obj"})
    EXPECT_THROW(prepare_surface(read_surface(test::shared_dir() / "data/bad" / name).mesh, {}),
                 Error)
        << name;
}

TEST(RealSurfaces, SharedModelsAreClosedManifolds) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const auto& file : files_in(test::shared_dir() / "data/models")) {
    const auto prepared = prepare_surface(read_surface(file).mesh, {});
    EXPECT_TRUE(prepared.diagnosis.is_closed) << file;
    EXPECT_TRUE(compute_topology(prepared.mesh).is_closed_manifold()) << file;
  }
}

}  // namespace
}  // namespace hexwright
