// The library keeps no state of its own: calls in several threads do not meet.
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

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
