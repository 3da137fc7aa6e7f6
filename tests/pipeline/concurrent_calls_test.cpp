// The library keeps no state of its own: calls in several threads do not meet, and neither do the
// threads within one. What the thread sanitizer watches (scripts/threads).
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

TEST(ConcurrentCalls, OfMeshSurfaceGiveWhatEachGivesAlone) {
  const TriMesh surfaces[] = {test::cylinder_surface(0, 1, 0, 1.5, 48),
                              test::unit_sphere_surface(4)};
  MeshResult alone[2], together[2];
  for (int i = 0; i < 2; ++i) alone[i] = mesh_surface(surfaces[i], {}, {});
  std::thread threads[2];
  for (int i = 0; i < 2; ++i)
    threads[i] = std::thread([&, i] { together[i] = mesh_surface(surfaces[i], {}, {}); });
  for (std::thread& t : threads) t.join();
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(alone[i].mesh.num_hexes(), 100u);
    EXPECT_EQ(together[i].mesh.positions.raw(), alone[i].mesh.positions.raw());
    EXPECT_EQ(together[i].mesh.hexes.raw(), alone[i].mesh.hexes.raw());
    EXPECT_EQ(together[i].warnings, alone[i].warnings);
  }
}

/// A bundled part with holes, sharp edges and wall layers, in second order: nearly every stage.
MeshResult mesh_plate(int threads) {
  const ThreadLimit limit(threads);
  MeshOptions options;
  options.sizing.max_level = 4;
  options.max_rounds = 1;
  options.order = 2;
  options.layers.specs = {parse_layer_spec("*=first:1%,growth:1.2,count:2")};
  const std::string path = std::string(HEXWRIGHT_SOURCE_DIR) + "/data/models/plate_holes.stl";
  return mesh_surface(read_surface(path).mesh, options, {});
}

TEST(ConcurrentCalls, FourThreadsMakeTheMeshOfOne) {
  const MeshResult one = mesh_plate(1), four = mesh_plate(4);
  EXPECT_GT(one.mesh.num_hexes(), 100u);
  EXPECT_EQ(four.mesh.positions.raw(), one.mesh.positions.raw());
  EXPECT_EQ(four.mesh.hexes.raw(), one.mesh.hexes.raw());
  EXPECT_EQ(four.layer.raw(), one.layer.raw());
}

TEST(ConcurrentCalls, CancelOnlyTheirOwn) {
  const TriMesh sphere = test::unit_sphere_surface(4);
  std::atomic<bool> is_cancelled = true;
  Context cancelled;
  cancelled.cancel = &is_cancelled;
  std::size_t num_hexes = 0;
  std::thread other([&] { num_hexes = mesh_surface(sphere, {}, {}).mesh.num_hexes(); });
  EXPECT_THROW(mesh_surface(sphere, {}, cancelled), Error);
  other.join();
  EXPECT_GT(num_hexes, 100u);
}

}  // namespace
}  // namespace hexwright
