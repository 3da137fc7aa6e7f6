// Whatever runs long ends soon after its caller's flag is set, with or without a Context of its
// own.
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "hexwright/base/cancel.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/carve.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/geometry/surface_tree.h"
#include "hexwright/grid/complete.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/set_table.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/judge.h"
#include "hexwright/relax/improve.h"
#include "hexwright/render/picture.h"
#include "hexwright/render/view_page.h"

#include "helpers.h"
#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using Work = std::function<void(const Context&)>;

::testing::AssertionResult is_cancelled(const Work& work, const Context& context) {
  try {
    work(context);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << error.what();
  }
  return ::testing::AssertionFailure() << "it ran to its end";
}

/// Runs each work with the flag set: in the Context, and in the scope around.
void expect_cancelled(const std::map<std::string, Work>& works) {
  const std::atomic<bool> stop{true};
  Context context;
  context.cancel = &stop;
  for (const auto& [name, work] : works) {
    EXPECT_TRUE(is_cancelled(work, context)) << name << ", by its context";
    const CancelScope scope(&stop);
    EXPECT_TRUE(is_cancelled(work, {})) << name << ", by the scope around";
  }
}

TEST(Cancelling, EndsEveryStage) {
  const TriMesh surface = test::unit_sphere_surface(4);
  const Target target = wrap_target(surface);
  const HexMesh hexes = test::box_hex_mesh(16, 16, 16);
  const Grid grid = test::random_grid({{0, 0, 0}, 1}, {{0, 0, 0}}, 5, 3);
  const Grid completed = complete(grid, {}, {}).grid;
  expect_cancelled({
      {"mesh", [&](const Context& c) { mesh_surface(surface, {}, c); }},
      {"prepare", [&](const Context& c) { prepare_surface(surface, c); }},
      {"target", [&](const Context& c) { make_target(surface, {}, c); }},
      {"grid", [&](const Context& c) { build_grid(target, {}, c); }},
      {"shape diameter", [&](const Context& c) { compute_shape_diameter(surface, {}, c); }},
      {"opposite walls", [&](const Context& c) { sample_opposite_walls(surface, 0.1, c); }},
      {"complete", [&](const Context& c) { complete(grid, {}, c); }},
      {"dual", [&](const Context& c) { build_dual(completed, {}, c); }},
      {"count hexes", [&](const Context& c) { count_dual_hexes(completed, {}, c); }},
      {"carve", [&](const Context& c) { carve(hexes, target.tree, {}, c); }},
      {"fit", [&](const Context& c) { fit(hexes, target, {}, c); }},
      {"judge", [&](const Context& c) { judge(hexes, {}, c); }},
      {"judge with surface", [&](const Context& c) { judge(hexes, target, {}, c); }},
      {"improve",
       [&](const Context& c) {
         HexMesh mesh = hexes;
         improve(mesh, {}, c);
       }},
  });
}

/// The same for functions without a Context: within the scope of the flag alone.
void expect_cancelled_within_scope(const std::map<std::string, std::function<void()>>& works) {
  const std::atomic<bool> stop{true};
  const CancelScope scope(&stop);
  for (const auto& [name, work] : works)
    EXPECT_TRUE(is_cancelled([&](const Context&) { work(); }, {})) << name;
}

TEST(Cancelling, EndsChecksAndQueries) {
  const SurfaceTree tree(test::unit_sphere_surface(4));
  const HexMesh hexes = test::box_hex_mesh(16, 16, 16);
  const Grid grid = complete(test::random_grid({{0, 0, 0}, 1}, {{0, 0, 0}}, 5, 3), {}, {}).grid;
  expect_cancelled_within_scope({
      {"balance", [&] { find_unbalanced(grid, Balance::Weak); }},
      {"relaxed balance", [&] { find_unbalanced(grid, Balance::Relaxed); }},
      {"pairing", [&] { find_unpaired(grid); }},
      {"coarsening", [&] { find_coarsened(grid, grid); }},
      {"tree", [&] { SurfaceTree(test::unit_sphere_surface(4)); }},
      {"topology", [&] { check_topology(hexes); }},
      {"quality", [&] { summarize_quality(hexes); }},
      {"distance", [&] { measure_distance(hexes, tree, {}); }},
      {"hexes around vertices", [&] { VertToHex around(hexes); }},
      {"neighbours", [&] { compute_hex_neighbors(hexes); }},
      {"indices", [&] { hexes.find_problem(); }},
      {"box", [&] { bounding_box(hexes); }},
      {"sets", [&] { make_set_table(hexes); }},
      {"page", [&] { make_view_page(hexes, {}); }},
      {"picture", [&] { render_hex_mesh(hexes, {}); }},
  });
}

TEST(Cancelling, EndsWritersOfEveryFormatAndLeavesNothing) {
  const test::TempFolder folder;
  const HexMesh hexes = test::box_hex_mesh(3, 3, 3);  // so small that only the file looks
  std::map<std::string, std::function<void()>> works;
  for (const std::string& extension : hex_mesh_extensions())
    works[extension] = [&, name = "a" + extension] { write_hex_mesh(folder / name, hexes); };
  expect_cancelled_within_scope(works);
  EXPECT_EQ(folder.num_files(), 0u);
}

TEST(Cancelling, EndsReadersOfEveryFormat) {
  const test::TempFolder folder;
  std::map<std::string, std::function<void()>> works;
  for (const char* name : {"a.obj", "a.off", "a.stl", "a.ply"}) {
    write_surface(folder / name, test::unit_sphere_surface(4));
    works[name] = [&folder, name] { read_surface(folder / name); };
  }
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
    write_hex_mesh(folder / name, test::box_hex_mesh(12, 12, 12));
    works[name] = [&folder, name] { read_hex_mesh(folder / name); };
  }
  for (const char* name : {"g.cells", "g.htg", "g.vtu", "g.mesh"}) {
    write_grid(folder / name, test::random_grid({{0, 0, 0}, 1}, test::kRingRoots, 5, 1));
    works[name] = [&folder, name] { read_grid(folder / name); };
  }
  std::string polygon = "OFF\n3000 1 0\n", face = "3000";
  for (int i = 0; i < 3000; ++i) {
    polygon += std::to_string(i) + " " + std::to_string(i * i % 7) + " 0\n";
    face += " " + std::to_string(i);
  }
  folder.write("polygon.off", polygon + face + "\n");
  works["polygon"] = [&folder] { read_surface(folder / "polygon.off"); };
  expect_cancelled_within_scope(works);
}

}  // namespace
}  // namespace hexwright
