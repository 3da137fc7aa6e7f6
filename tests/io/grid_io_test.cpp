// Reading and writing adaptive grids.
#include "hexwright/io/grid_io.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "helpers.h"
#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::random_grid;
using test::TempFolder;

void expect_same(const Grid& a, const Grid& b, const std::string& what) {
  EXPECT_EQ(a.frame, b.frame) << what;
  EXPECT_EQ(a.roots, b.roots) << what;
  EXPECT_EQ(a.finest_level, b.finest_level) << what;
  EXPECT_EQ(a.cells, b.cells) << what;
}

TEST(GridIo, SingleRootsSurviveEveryFormat) {
  const TempFolder folder;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Grid grid = random_grid({{-3, 0.5, 1e3}, 7.5}, {{0, 0, 0}}, int(seed), seed);
    for (const char* name : {"a.cells", "a.htg", "a.vtu", "a.mesh"}) {
      write_grid(folder / name, grid);
      expect_same(read_grid(folder / name), grid, name + std::string(", seed ") + char('0' + seed));
    }
  }
}

TEST(GridIo, StretchedGridsSurviveEveryFormat) {
  const TempFolder folder;
  for (const Vec3& stretch : {Vec3{1, 0.8, 0.95}, Vec3{0.7, 1, 1}, Vec3{0.3, 0.6, 1}}) {
    Grid grid = random_grid({{-3, 0.5, 10}, 7.5}, {{0, 0, 0}}, 3, 1);
    grid.frame.stretch = stretch;
    for (const char* name : {"a.cells", "a.htg", "a.vtu", "a.vtk", "a.mesh"}) {
      if (std::string(name) == "a.vtk")  // as hexes of any program: nothing says where roots lie
        write_hex_mesh(folder / name, read_hex_mesh(folder / "a.vtu"));
      else
        write_grid(folder / name, grid);
      const Grid back = read_grid(folder / name);
      EXPECT_EQ(back.cells, grid.cells) << name;
      EXPECT_NEAR(back.frame.root_size, 7.5, 1e-12) << name;
      EXPECT_LT(distance(back.frame.origin, grid.frame.origin), 1e-12) << name;
      EXPECT_LT(distance(back.frame.stretch, stretch), 1e-13) << name;
    }
  }
}

TEST(GridIo, CellsOfDifferentProportionsAreRefused) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  for (Vec3& p : mesh.positions) p.x *= p.x;  // a cube, and one three times as long
  write_hex_mesh(folder / "a.vtk", mesh);
  try {
    read_grid(folder / "a.vtk");
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("proportions"), std::string::npos) << error.what();
  }
}

TEST(GridIo, DomainsOfSeveralRootsSurvive) {
  const TempFolder folder;
  const Grid grid = random_grid({{1, 2, 3}, 0.1}, test::kRingRoots, 3, 5);
  for (const char* name : {"a.cells", "a.vtu", "a.htg"}) {
    write_grid(folder / name, grid);
    const Grid back = read_grid(folder / name);
    EXPECT_EQ(back.roots, grid.roots) << name;
    EXPECT_EQ(back.cells, grid.cells) << name;
    EXPECT_NEAR(back.frame.root_size, 0.1, 1e-15) << name;
  }
}

TEST(GridIo, NegativeRootsKeepTheirPlaceInTheWorld) {
  const TempFolder folder;
  const Grid grid = random_grid({{0, 0, 0}, 2}, {{-2, 0, 0}, {-1, 0, 0}, {-1, 1, -3}}, 2, 3);
  for (const char* name : {"a.cells", "a.vtu", "a.htg", "a.mesh"}) {
    write_grid(folder / name, grid);
    const Grid back = read_grid(folder / name);
    EXPECT_FALSE(back.find_problem()) << name;
    ASSERT_EQ(back.num_cells(), grid.num_cells()) << name;
    double volume = 0;
    Box3 box;
    for (CellId c : back.cells.ids()) {
      const Vec3 size = cell_box(back, c).extent();
      volume += size.x * size.y * size.z;
      box.extend(cell_box(back, c));
    }
    EXPECT_DOUBLE_EQ(volume, 3 * 8.0) << name;
    EXPECT_EQ(box.lo, (Vec3{-4, 0, -6})) << name;
    EXPECT_EQ(box.hi, (Vec3{0, 4, 2})) << name;
  }
}

TEST(GridIo, LargestRootsThatTileTheDomainAreFoundInForeignHexes) {
  const TempFolder folder;
  // An octree in one cube whose coarsest cells are an eighth of it: no hex shows the root's size.
  Grid grid = make_root_grid({{5, 5, 5}, 3});
  for (int k = 0; k < 2; ++k) grid = split_cells(grid, std::vector<char>(grid.num_cells(), 1));
  write_grid(folder / "cube.mesh", grid);
  expect_same(read_grid(folder / "cube.mesh"), grid, "regular cube");
  // A ring of cubes has no larger root than its own cubes.
  const Grid ring = random_grid({{0, 0, 0}, 1}, test::kRingRoots, 2, 11);
  write_grid(folder / "ring.mesh", ring);
  expect_same(read_grid(folder / "ring.mesh"), ring, "ring");
}

TEST(GridIo, RoundedCoordinatesAreSnappedToTheLattice) {
  const TempFolder folder;
  const Grid grid = random_grid({{0, 0, 0}, 1}, {{0, 0, 0}}, 5, 2);
  HexMesh mesh;
  write_grid(folder / "a.mesh", grid);
  mesh = read_hex_mesh(folder / "a.mesh");
  for (Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] / 3 * 1e5) / 1e5;
  write_hex_mesh(folder / "b.mesh", mesh);
  EXPECT_EQ(read_grid(folder / "b.mesh").cells, grid.cells);
}

TEST(GridIo, CellsHeaderListsRootsInAnyForm) {
  const TempFolder folder;
  const auto further = folder.write("a.cells", "# roots 1 0 0\n0 0 0 0\n0 1 0 0 # the second\n");
  const auto all = folder.write("b.cells",
                                "# made by hand\n#roots 0 0 0\n# roots 1 0 0\n\n0 0 0 0\r\n"
                                "\t0 1 0 0");
  expect_same(read_grid(further), read_grid(all), "listed all or only further");
  const auto apart = folder.write("c.cells", "# roots 3 0 0\n# origin 1 2 3 size 4\n0 3 0 0\n");
  const Grid grid = read_grid(apart);
  EXPECT_EQ(grid.roots, (std::vector<LatticeCoord>{{3, 0, 0}}));
  EXPECT_EQ(cell_box(grid, CellId(0)).lo, (Vec3{13, 2, 3}));
}

TEST(GridIo, DamagedGridsAreRefusedWithLineOrCell) {
  const TempFolder folder;
  const std::string hex_head =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n"
      "0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1.2 0\nHexahedra 1\n1 2 3 4 5 6 7 8 0\nEnd\n";
  const struct {
    const char* name;
    std::string content;
    const char* part;
  } cases[] = {{"empty.cells", "", "empty"},
               {"comment.cells", "# nothing\n", "no cell"},
               {"three.cells", "0 0 0\n", "three.cells:1"},
               {"five.cells", "# x\n0 0 0 0 0\n", "five.cells:2"},
               {"word.cells", "0 0 0 x\n", "word.cells:1"},
               {"level.cells", "21 0 0 0\n", "level.cells:1"},
               {"huge.cells", "0 0 0 99999999999\n", "huge.cells:1"},
               {"origin.cells", "# origin 0 0 0 size -1\n0 0 0 0\n", "origin.cells:1"},
               {"root.cells", "# roots 0 0\n0 0 0 0\n", "root.cells:1"},
               {"outside.cells", "0 0 0 0\n0 1 0 0\n", "level 0, index 1 0 0"},
               {"gap.cells", "1 0 0 0\n1 1 0 0\n", "no cell covers"},
               {"twice.cells", "0 0 0 0\n0 0 0 0\n", "overlaps"},
               {"skew.mesh", hex_head, "hex 0"},
               {"trunc.htg", "<VTKFile type=\"HyperTreeGrid\" version=\"2.0\"><Hyper", "XML"}};
  for (const auto& c : cases) {
    try {
      read_grid(folder.write(c.name, c.content));
      ADD_FAILURE() << c.name << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << c.name;
      EXPECT_NE(std::string(error.what()).find(c.part), std::string::npos) << error.what();
      EXPECT_NE(error.where().find(c.name), std::string::npos) << error.where();
    }
  }
}

TEST(GridIo, SharedGridsSurviveEveryFormat) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  const TempFolder folder;
  const Grid grid = read_grid(test::shared_dir() / "baseline/grids/3holes.cells");
  for (const char* name : {"a.cells", "a.htg", "a.vtu", "a.mesh"}) {
    write_grid(folder / name, grid);
    expect_same(read_grid(folder / name), grid, name);
  }
}

}  // namespace
}  // namespace hexwright
