// Round trips of numbers at the edges of their types, of random meshes, and of bytes.
#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/io/mesh_io.h"
#include "hexwright/io/surface_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

/// Denormals, the largest, signed zeros, values that no short decimal gives.
const double kNumbers[] = {0.0,
                           -0.0,
                           5e-324,
                           -5e-324,
                           2.2250738585072014e-308,
                           1e-200,
                           1.0 / 3,
                           0.1,
                           -0.1,
                           3.141592653589793,
                           1e15 / 7,
                           1e16,
                           123456789.0,
                           1e200,
                           -1.7976931348623157e308,
                           1.7976931348623157e308};

double any_number(std::mt19937_64& random) {
  if (random() % 2 == 0) return kNumbers[random() % std::size(kNumbers)];
  while (true) {  // any finite bit pattern
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

void randomize(IdVector<VertId, Vec3>& positions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (Vec3& p : positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = any_number(random);
}

/// By bits, so that the sign of zero counts too.
void expect_same_bits(const IdVector<VertId, Vec3>& a, const IdVector<VertId, Vec3>& b,
                      const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (VertId v : a.ids())
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a[v][axis]), std::bit_cast<std::uint64_t>(b[v][axis]))
          << what << ": vertex " << v.value() << ", " << a[v][axis] << " and " << b[v][axis];
}

TEST(ExtremeNumbers, HexMeshesKeepEveryBit) {
  const TempFolder folder;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    HexMesh mesh = test::labelled_box();
    randomize(mesh.positions, seed);
    mesh.region[HexId(0)] = std::numeric_limits<std::int32_t>::max();
    mesh.region[HexId(1)] = std::numeric_limits<std::int32_t>::min();
    for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
      write_hex_mesh(folder / name, mesh);
      const HexMesh back = read_hex_mesh(folder / name);
      expect_same_bits(back.positions, mesh.positions, name);
      EXPECT_EQ(back.region, mesh.region) << name;
      EXPECT_TRUE(back.labels == mesh.labels) << name;
    }
  }
}

TEST(ExtremeNumbers, SurfacesKeepEveryBitWhereTheFormatHasThem) {
  const TempFolder folder;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TriMesh cube = test::unit_cube_surface();
    randomize(cube.positions, seed);
    for (const char* name : {"a.obj", "a.off", "a.ply"}) {
      write_surface(folder / name, cube);
      const TriMesh back = read_surface(folder / name).mesh;
      expect_same_bits(back.positions, cube.positions, name);
      EXPECT_EQ(back.tris, cube.tris) << name;
    }
  }
}

// STL has single precision: what comes back is the nearest float.
TEST(ExtremeNumbers, StlRoundsToTheNearestFloat) {
  const TempFolder folder;
  TriMesh cube = test::unit_cube_surface();
  std::mt19937_64 random(3);
  for (Vec3& p : cube.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = double(random()) / 1e19 - 0.7;
  write_surface(folder / "a.stl", cube);
  const TriMesh back = read_surface(folder / "a.stl").mesh;
  ASSERT_EQ(back.num_tris(), cube.num_tris());
  for (TriId t : cube.tris.ids())
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(back.corners(t)[k][axis], double(float(cube.corners(t)[k][axis])));
}

// The same mesh gives the same bytes, and what was read gives them again.
TEST(ExtremeNumbers, WritingIsAFunctionOfTheMesh) {
  const TempFolder folder;
  HexMesh mesh = test::labelled_box();
  randomize(mesh.positions, 77);
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
    write_hex_mesh(folder / name, mesh);
    const std::string first = test::slurp(folder / name);
    write_hex_mesh(folder / name, read_hex_mesh(folder / name));
    EXPECT_EQ(test::slurp(folder / name), first) << name;
  }
  TriMesh cube = test::unit_cube_surface();
  randomize(cube.positions, 78);
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    write_surface(folder / name, cube);
    const std::string first = test::slurp(folder / name);
    write_surface(folder / name, read_surface(folder / name).mesh);
    EXPECT_EQ(test::slurp(folder / name), first) << name;
  }
}

}  // namespace
}  // namespace hexwright
