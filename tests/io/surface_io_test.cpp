// Reading and writing surfaces: every format, odd and broken files.
#include "hexwright/io/surface_io.h"

#include <fstream>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "helpers.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::bundled;
using test::TempFolder;

/// Six times the enclosed volume, which tells orientation and completeness at once.
double volume6(const TriMesh& mesh) {
  double sum = 0;
  for (TriId t : mesh.tris.ids()) {
    const auto p = mesh.corners(t);
    sum += det(p[0], p[1], p[2]);
  }
  return sum;
}

TEST(ReadSurface, ReadsEveryBundledModel) {
  const struct {
    const char* file;
    const char* format;
    std::size_t num_tris;
  } cases[] = {{"models/3holes.obj", "OBJ", 3982},
               {"models/cube_minus_sphere.obj", "OBJ", 4128},
               {"models/plate_holes.stl", "STL (binary)", 1252},
               {"models/20mm-xyz-cube.stl", "STL (binary)", 260},
               {"models/spot_low_resolution.obj", "OBJ", 1654}};
  for (const auto& c : cases) {
    const SurfaceFile file = read_surface(bundled(c.file));
    EXPECT_EQ(file.mesh.num_tris(), c.num_tris) << c.file;
    EXPECT_EQ(file.format, c.format) << c.file;
    EXPECT_FALSE(file.mesh.find_problem()) << c.file;
    EXPECT_GT(volume6(file.mesh), 0) << c.file;
    EXPECT_TRUE(file.warnings.empty()) << c.file;
  }
}

/// A gzip file without compression, of as many members as there are texts (RFC 1951, 1952).
std::string gzip_of(const std::vector<std::string>& texts) {
  std::string out;
  const auto put = [&](std::uint32_t value, int num_bytes) {
    for (int k = 0; k < num_bytes; ++k) out += static_cast<char>(value >> (8 * k) & 255);
  };
  for (const std::string& text : texts) {
    out += std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff\x01", 11);  // one stored block, the last
    put(static_cast<std::uint32_t>(text.size()), 2);
    put(~static_cast<std::uint32_t>(text.size()), 2);
    out += text;
    std::uint32_t crc = ~0u;
    for (unsigned char c : text) {
      crc ^= c;
      for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    put(~crc, 4);
    put(static_cast<std::uint32_t>(text.size()), 4);
  }
  return out;
}

TEST(ReadSurface, PackedFilesAreReadWhateverTheirName) {
  const std::string verts = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const TempFolder folder;
  const std::string packed = gzip_of({verts, faces});
  const SurfaceFile named = read_surface(folder.write("tet.obj.gz", packed));
  EXPECT_EQ(named.mesh.num_tris(), 4u);
  EXPECT_TRUE(named.warnings.empty());
  const SurfaceFile misnamed = read_surface(folder.write("tet.obj", packed));
  EXPECT_EQ(misnamed.mesh.num_tris(), 4u);
  ASSERT_EQ(misnamed.warnings.size(), 1u);
  EXPECT_NE(misnamed.warnings[0].find("gzip"), std::string::npos);
  for (std::size_t size : {packed.size() - 3, packed.size() / 2, std::size_t{12}})
    EXPECT_THROW(read_surface(folder.write("cut.obj.gz", packed.substr(0, size))), Error) << size;
  std::string damaged = packed;
  damaged[20] = 'x';
  EXPECT_THROW(read_surface(folder.write("bad.obj.gz", damaged)), Error);
  try {
    read_surface(folder.write("archive.stl", std::string("PK\x03\x04") + std::string(99, 'x')));
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("ZIP archive"), std::string::npos) << e.what();
  }
}

TEST(ReadSurface, OddlyWrittenCubesAreWholeCubes) {
  for (const char* name : {"crlf_tabs_comments.obj", "negative_indices.obj", "quads.obj"}) {
    const TriMesh mesh = read_surface(bundled("bad") / name).mesh;
    EXPECT_EQ(mesh.num_tris(), 12u) << name;
    EXPECT_DOUBLE_EQ(volume6(mesh), 6 * 8.0) << name;
  }
}

TEST(ReadSurface, BadFilesAreRefusedWithPlaceAndReason) {
  const struct {
    const char* file;
    const char* where;    // end of the place
    const char* message;  // part of the message
  } cases[] = {{"empty.obj", "empty.obj", "empty"},
               {"empty.off", "empty.off", "empty"},
               {"empty.ply", "empty.ply", "empty"},
               {"empty.stl", "empty.stl", "empty"},
               {"header_only.off", "header_only.off:2", "truncated"},
               {"index_out_of_range.obj", "index_out_of_range.obj:22", "uses vertex"},
               {"not_a_mesh.obj", "not_a_mesh.obj:1", "OBJ"},
               {"word_coordinates.obj", "word_coordinates.obj:1", "expected a number"},
               {"zero_index.obj", "zero_index.obj:5", "start at 1"},
               {"zero_elements.off", "zero_elements.off", "no face"},
               {"ply_bad_header.ply", "ply_bad_header.ply:6", "header"},
               {"ply_truncated_binary.ply", "face 146", "truncated"},
               {"stl_ascii_truncated.stl", "stl_ascii_truncated.stl:304", "truncated"},
               {"stl_header_short.stl", "stl_header_short.stl", "84"},
               {"stl_truncated.stl", "facet 158", "truncated"},
               {"truncated.off", "truncated.off:322", "face 160 of 320"},
               {"truncated_vertices.off", "truncated_vertices.off:74", "vertex 72 of 160"},
               {"nan_coordinates.obj", "nan_coordinates.obj:5", "not finite"},
               {"inf_coordinates.obj", "inf_coordinates.obj:5", "not finite"}};
  for (const auto& c : cases) {
    try {
      read_surface(bundled("bad") / c.file);
      ADD_FAILURE() << c.file << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << c.file;
      EXPECT_TRUE(error.where().ends_with(c.where)) << error.where();
      EXPECT_NE(std::string(error.what()).find(c.message), std::string::npos) << error.what();
    }
  }
}

TEST(ReadSurface, WrongCountsAndNamesGiveWarningsNotErrors) {
  for (const char* name : {"off_named.obj", "stl_count_max.stl", "stl_count_too_big.stl",
                           "stl_count_too_small.stl", "stl_count_zero.stl"}) {
    const SurfaceFile file = read_surface(bundled("bad") / name);
    EXPECT_EQ(file.mesh.num_tris(), 320u) << name;
    EXPECT_EQ(file.warnings.size(), 1u) << name;
  }
  const SurfaceFile file = read_surface(bundled("bad/stl_solid_header_binary.stl"));
  EXPECT_EQ(file.format, "STL (binary)");
  EXPECT_TRUE(file.warnings.empty());
}

TEST(ReadSurface, AbsentFilesAndFoldersAreRefused) {
  for (const auto& path : {bundled("no_such_file.obj"), bundled("models")}) {
    try {
      read_surface(path);
      ADD_FAILURE() << path << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::CannotOpen);
      EXPECT_EQ(error.where(), path.string());
    }
  }
}

TEST(WriteSurface, EveryFormatReadsBackTheSame) {
  const TempFolder folder;
  TriMesh cube = test::unit_cube_surface();
  cube.positions[VertId(0)] = {1.0 / 3, -1e-300, 12345.678901234567};
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    write_surface(folder / name, cube);
    const SurfaceFile back = read_surface(folder / name);
    EXPECT_EQ(back.mesh.positions, cube.positions) << name;
    EXPECT_EQ(back.mesh.tris, cube.tris) << name;
    EXPECT_TRUE(back.warnings.empty()) << name;
  }
  write_surface(folder / "a.stl", test::unit_cube_surface());
  EXPECT_DOUBLE_EQ(volume6(read_surface(folder / "a.stl").mesh), 6);
  EXPECT_EQ(folder.num_files(), 4u);  // and nothing written aside is left
}

TEST(ReadSurface, SharedBadFilesParseOrAreRefused) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  std::size_t num_files = 0, num_read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::shared_dir() / "data/bad")) {
    ++num_files;
    try {
      const SurfaceFile file = read_surface(entry.path());
      EXPECT_FALSE(file.mesh.find_problem()) << entry.path();
      EXPECT_EQ(entry.path().filename().string().find("truncated"), std::string::npos);
      ++num_read;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      EXPECT_NE(error.where().find(entry.path().filename().string()), std::string::npos);
    }
  }
  EXPECT_EQ(num_files, 79u);
  EXPECT_EQ(num_read, 60u);
}

TEST(ReadSurface, SharedModelsAllRead) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const auto& entry :
       std::filesystem::directory_iterator(test::shared_dir() / "data/models")) {
    const SurfaceFile file = read_surface(entry.path());
    EXPECT_FALSE(file.mesh.find_problem()) << entry.path();
    EXPECT_TRUE(file.warnings.empty()) << entry.path() << ": " << file.warnings[0];
  }
}

}  // namespace
}  // namespace hexwright
