// Memory that runs out at any moment is std::bad_alloc or an Error, and leaves nothing behind that
// the next call would trip over. The program's own operator new fails at a chosen allocation.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "helpers.h"
#include "io/temp_folder.h"

namespace {

std::atomic<long> allocations_left{-1};  // negative: never fail

}  // namespace

// Not inlined: the compiler would take free() for the wrong partner of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace hexwright {
namespace {

/// Runs `work` again and again, letting each time a later allocation fail, until it succeeds.
/// Returns how often it failed.
template <class Work>
int fail_everywhere(Work&& work) {
  int num_failed = 0;
  for (long at = 0;; at += 1 + at / 8) {
    allocations_left = at;
    try {
      work();
      const bool was_spared = allocations_left >= 0;
      allocations_left = -1;
      if (was_spared) return num_failed;
    } catch (const std::bad_alloc&) {
      ++num_failed;
    } catch (const Error& error) {
      allocations_left = -1;
      EXPECT_EQ(error.code(), ErrorCode::OutOfResources) << error.what();
      ++num_failed;
    }
    allocations_left = -1;
  }
}

TEST(FailingAllocation, IsAnErrorOfEveryStage) {
  const TriMesh surface = test::unit_sphere_surface(2);
  MeshOptions options;
  options.sizing.max_level = 3;
  options.max_rounds = 0;
  const MeshResult expected = mesh_surface(surface, options, {});
  MeshResult result;
  EXPECT_GT(fail_everywhere([&] { result = mesh_surface(surface, options, {}); }), 20);
  EXPECT_EQ(result.mesh.positions, expected.mesh.positions) << "a failure left its trace";
}

TEST(FailingAllocation, IsAnErrorOfReadersAndWriters) {
  const test::TempFolder folder;
  write_hex_mesh(folder / "a.vtu", test::box_hex_mesh(3, 3, 3));
  write_surface(folder / "a.obj", test::unit_sphere_surface(2));
  EXPECT_GT(fail_everywhere([&] { read_hex_mesh(folder / "a.vtu"); }), 20);
  EXPECT_GT(fail_everywhere([&] { read_surface(folder / "a.obj"); }), 5);
  const TriMesh surface = test::unit_cube_surface();
  EXPECT_GT(fail_everywhere([&] { write_surface(folder / "b.ply", surface); }), 5);
  EXPECT_EQ(folder.num_files(), 3u) << "a file written aside is left";
}

}  // namespace
}  // namespace hexwright
