// Damaged files: whatever bytes are cut or changed, readers give a sound result or an Error, and
// soon.
#include <algorithm>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/surface_io.h"

#include "io/sample_meshes.h"
#include "io/surface_samples.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;
namespace fs = std::filesystem;

/// Reads one file, checks what comes out and returns the number of elements; throws Error when the
/// file is refused.
using Reader = std::function<std::size_t(const fs::path&)>;

std::size_t read_and_check_surface(const fs::path& path) {
  const SurfaceFile file = read_surface(path);
  EXPECT_FALSE(file.mesh.find_problem()) << path;
  EXPECT_GT(file.mesh.num_tris(), 0u) << path;
  return file.mesh.num_tris();
}
std::size_t read_and_check_hexes(const fs::path& path) {
  const HexMesh mesh = read_hex_mesh(path);
  EXPECT_FALSE(mesh.find_problem()) << path;
  return mesh.num_hexes();
}
std::size_t read_and_check_grid(const fs::path& path) {
  const Grid grid = read_grid(path);
  EXPECT_FALSE(grid.find_problem()) << path;
  return grid.num_cells();
}

/// The number of elements, 0 when the file is refused. Anything thrown but Error fails the test.
std::size_t try_read(const Reader& read, const fs::path& path) {
  try {
    return read(path);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ErrorCode::BadFile || error.code() == ErrorCode::CannotOpen)
        << error.what();
    EXPECT_FALSE(error.where().empty()) << error.what();
    return 0;
  }
}

struct Sample {
  std::string name;
  std::string bytes;
  Reader read;
};

/// Small files of every format that is read.
std::vector<Sample> make_samples(const TempFolder& folder) {
  std::vector<Sample> samples;
  const auto add = [&](const std::string& name, const Reader& read) {
    samples.push_back({name, test::slurp(folder / name), read});
  };
  for (const char* name : {"a.obj", "a.off", "a.stl", "a.ply"}) {
    write_surface(folder / name, test::unit_cube_surface());
    add(name, read_and_check_surface);
  }
  folder.write("text.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nproperty uchar red\nelement face 4\n"
               "property list uchar int vertex_indices\nend_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n"
               "0 0 1 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  add("text.ply", read_and_check_surface);
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"s.msh", test::kGmshTetrahedron},
           {"s.vtk", test::kVtkTetrahedron},
           {"s.vtp", test::kVtpTetrahedron},
           {"s.bdf", test::kNastranTetrahedron},
           {"s.3mf", test::zip_of({{"a.model", test::k3mfModel}})}}) {
    folder.write(name, text);
    add(name, read_and_check_surface);
  }
  folder.write("text.stl",
               "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
               "   vertex 0 1 0\n  endloop\n endfacet\nendsolid a b\n");
  add("text.stl", read_and_check_surface);
  for (const char* name :
       {"a.vtu", "a.vtk", "a.mesh", "a.msh", "a.msh2", "a.inp", "a.exo", "a.mfem"}) {
    write_hex_mesh(folder / name, test::labelled_box());
    add(name, read_and_check_hexes);
  }
  const Grid grid = test::random_grid({{0, 0, 0}, 1}, test::kRingRoots, 2, 1);
  for (const char* name : {"g.cells", "g.htg", "g.vtu", "g.mesh"}) {
    write_grid(folder / name, grid);
    add(name, read_and_check_grid);
  }
  return samples;
}

TEST(DamagedFiles, TruncatedFilesAreNeverPartialMeshes) {
  const TempFolder folder;
  constexpr std::size_t kCuts = 400;
  for (const Sample& sample : make_samples(folder)) {
    const std::size_t whole = try_read(sample.read, folder / sample.name);
    EXPECT_GT(whole, 0u) << sample.name;
    // OBJ, Abaqus and Nastran say nowhere how many elements there are, and neither does binary STL
    // reliably.
    const bool is_counted = sample.name != "a.obj" && sample.name != "a.stl" &&
                            sample.name != "a.inp" && sample.name != "s.bdf";
    const std::size_t step = std::max<std::size_t>(1, sample.bytes.size() / kCuts);
    for (std::size_t size = sample.bytes.size() % step; size < sample.bytes.size(); size += step) {
      const auto got =
          try_read(sample.read, folder.write(sample.name, sample.bytes.substr(0, size)));
      EXPECT_TRUE(!is_counted || got == 0 || got == whole)
          << sample.name << " cut at " << size << ": " << got << " of " << whole;
    }
  }
}

TEST(DamagedFiles, ChangedBytesAreSoundOrRefused) {
  const TempFolder folder;
  constexpr int kRounds = 800;
  std::mt19937 random(20210);
  for (const Sample& sample : make_samples(folder)) {
    for (int round = 0; round < kRounds; ++round) {
      std::string bytes = sample.bytes;
      const std::size_t num_changes = 1 + random() % 4;
      for (std::size_t k = 0; k < num_changes; ++k) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 4) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ 1 << random() % 8);
            break;
          case 2:  // a piece repeated somewhere else
            bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 32));
            break;
          default:  // a digit made large: counts and indices go wild
            bytes.replace(at, 1, "4294967295");
        }
      }
      try_read(sample.read, folder.write(sample.name, bytes));
    }
  }
}

TEST(DamagedFiles, RandomBytesUnderAnyNameAreRefused) {
  const TempFolder folder;
  std::mt19937 random(4);
  for (const char* name : {"a.obj", "a.off", "a.stl", "a.ply", "a.vtk", "a.vtu", "a.mesh", "a.msh",
                           "a.inp", "a.exo", "a.mfem", "a.cells", "a.htg", "a"}) {
    for (std::size_t size : {1u, 83u, 85u, 1000u}) {
      std::string bytes(size, '\0');
      for (char& c : bytes) c = static_cast<char>(random());
      const fs::path path = folder.write(name, bytes);
      EXPECT_EQ(try_read(read_and_check_surface, path), 0u) << name << " of " << size;
      EXPECT_EQ(try_read(read_and_check_hexes, path), 0u) << name << " of " << size;
      EXPECT_EQ(try_read(read_and_check_grid, path), 0u) << name << " of " << size;
    }
  }
}

}  // namespace
}  // namespace hexwright
