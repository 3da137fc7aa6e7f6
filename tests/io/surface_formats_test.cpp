// Details of the surface formats: numbers, counts, polygons, headers.
#include <algorithm>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/surface_io.h"

#include "helpers.h"
#include "io/temp_folder.h"
#include "io/text/byte_reader.h"

namespace hexwright {
namespace {

using io::ByteOrder;
using test::TempFolder;

SurfaceFile read_text(const std::string& name, const std::string& content) {
  const TempFolder folder;
  return read_surface(folder.write(name, content));
}

/// The message of the Error that reading must throw.
std::string refusal(const std::string& name, const std::string& content) {
  try {
    read_text(name, content);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << name << " was accepted";
  return "";
}

Vec3 area_vector(const TriMesh& mesh) {
  Vec3 sum;
  for (TriId t : mesh.tris.ids()) {
    const auto p = mesh.corners(t);
    sum += cross(p[1] - p[0], p[2] - p[0]) * 0.5;
  }
  return sum;
}
double sum_of_areas(const TriMesh& mesh) {
  double sum = 0;
  for (TriId t : mesh.tris.ids()) {
    const auto p = mesh.corners(t);
    sum += norm(cross(p[1] - p[0], p[2] - p[0])) * 0.5;
  }
  return sum;
}

TEST(Obj, AllFormsOfIndicesMeanTheSame) {
  const std::string verts = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  const auto plain = read_text("a.obj", verts + "f 1 2 3\n").mesh;
  for (const char* face : {"f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1",
                           "f 1 \\\n 2 3", "  f\t1  2\t3  # face", "fo 1 2 3"})
    EXPECT_EQ(read_text("a.obj", verts + face).mesh.tris, plain.tris) << face;
  EXPECT_EQ(read_text("a.obj", "f 1 2 3\n" + verts).mesh.tris, plain.tris) << "face first";
}

TEST(Obj, NumbersAreReadInEveryUsualForm) {
  const TriMesh mesh = read_text("a.obj",
                                 "\xEF\xBB\xBFv +1.5 -.25 1e3 1.0\n"
                                 "v 1E-400 2. -0 0.5 0.5 0.5\nf 1 2 1\n")
                           .mesh;
  EXPECT_EQ(mesh.positions[VertId(0)], (Vec3{1.5, -0.25, 1000}));
  EXPECT_EQ(mesh.positions[VertId(1)], (Vec3{0, 2, 0}));
  for (const char* number : {"0x1", "1,5", "1e", "--1", "1.2.3", "1e999", "-inf", "NaN"})
    EXPECT_NE(refusal("a.obj", std::string("v 0 0 0\nv 0 0 ") + number).find("a.obj:2"),
              std::string::npos)
        << number;
}

TEST(Stl, CountsAreJudgedByTheFilesSize) {
  const std::string whole = test::slurp(test::bundled("models/20mm-xyz-cube.stl"));
  const auto with_count = [&](std::uint32_t count) {
    std::string field, bytes = whole;
    io::store(field, count, ByteOrder::Little);
    return bytes.replace(80, 4, field);
  };
  for (std::uint32_t count : {0u, 1u, 259u, 261u, 4294967295u}) {
    const SurfaceFile file = read_text("a.stl", with_count(count));
    EXPECT_EQ(file.mesh.num_tris(), 260u) << count;
    ASSERT_EQ(file.warnings.size(), 1u) << count;
    EXPECT_NE(file.warnings[0].find(std::to_string(count)), std::string::npos);
  }
  const SurfaceFile longer = read_text("a.stl", whole + "some tail");
  EXPECT_EQ(longer.mesh.num_tris(), 260u);
  EXPECT_EQ(longer.warnings.size(), 1u);
  const std::string cut = whole.substr(0, whole.size() - 60);
  EXPECT_NE(refusal("a.stl", cut).find("facet 258"), std::string::npos) << refusal("a.stl", cut);
}

TEST(Stl, TextMayHoldSeveralSolidsAndAnyCase) {
  const std::string facet =
      "FACET NORMAL nan nan nan\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\n"
      "ENDFACET\n";
  const SurfaceFile file = read_text(
      "a.stl", "SOLID one\n" + facet + "ENDSOLID one\nsolid\n" + facet + facet + "endsolid\n");
  EXPECT_EQ(file.mesh.num_tris(), 3u);
  EXPECT_EQ(file.format, "STL (text)");
  EXPECT_NE(refusal("a.stl", "solid a\n" + facet).find("truncated"), std::string::npos);
}

TEST(Off, HeadersWithColoursAndNormalsAreTold) {
  const std::string verts = "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n";
  for (const char* header :
       {"OFF\n3 1 0\n", "COFF 3 1 3\n", "NOFF\n# c\n3 1\n", "STCNOFF\n3 1 0\n"})
    EXPECT_EQ(read_text("a.off", header + verts + "3 0 1 2 255 0 0\n").mesh.num_tris(), 1u)
        << header;
  EXPECT_EQ(read_text("a.off", "3 1 0\n" + verts + "3 0 1 2\n").mesh.num_tris(), 1u) << "bare";
  EXPECT_NE(refusal("a.off", "4OFF\n3 1 0\n").find("three"), std::string::npos);
  EXPECT_NE(refusal("a.off", "OFF BINARY\n3 1 0\n").find("binary"), std::string::npos);
  EXPECT_NE(refusal("a.off", "OFF\n3 1 0\n" + verts + "3 0 1 3\n").find("a.off:6"),
            std::string::npos);
  const SurfaceFile more = read_text("a.off", "OFF\n3 2 0\n" + verts + "2 0 1\n3 0 1 2\n3 0 2 1\n");
  EXPECT_EQ(more.mesh.num_tris(), 1u);
  EXPECT_EQ(more.warnings.size(), 2u);  // a face of two vertices, and a face too many
}

/// A tetrahedron as binary PLY: doubles, an extra property, short indices, an element in between.
std::string binary_ply(ByteOrder order) {
  std::string out = "ply\r\nformat ";
  out += order == ByteOrder::Big ? "binary_big_endian" : "binary_little_endian";
  out +=
      " 1.0\r\ncomment x\r\nobj_info y\r\nelement vertex 4\r\nproperty double z\r\n"
      "property uchar red\r\nproperty float y\r\nproperty short x\r\nelement extra 1\r\n"
      "property list uchar double stuff\r\nelement face 4\r\nproperty float quality\r\n"
      "property list ushort short vertex_index\r\nend_header\r\n";
  const int points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (const auto& p : points) {
    io::store(out, double(p[2]), order);
    out.push_back('\x7f');
    io::store(out, float(p[1]), order);
    io::store(out, std::int16_t(p[0]), order);
  }
  out.push_back(2);
  io::store(out, 1.0, order);
  io::store(out, 2.0, order);
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const auto& f : faces) {
    io::store(out, 0.5f, order);
    io::store(out, std::uint16_t{3}, order);
    for (int v : f) io::store(out, std::int16_t(v), order);
  }
  return out;
}

TEST(Ply, EitherByteOrderAndAnyTypesGiveTheSame) {
  const TriMesh little = read_text("a.ply", binary_ply(ByteOrder::Little)).mesh;
  const TriMesh big = read_text("a.ply", binary_ply(ByteOrder::Big)).mesh;
  EXPECT_EQ(little.positions, big.positions);
  EXPECT_EQ(little.tris, big.tris);
  EXPECT_EQ(little.positions[VertId(3)], (Vec3{0, 0, 3}));
  EXPECT_NEAR(norm(area_vector(little)), 0, 1e-12) << "closed";
}

TEST(Ply, StripsTurnEverySecondTriangle) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  const TriMesh mesh = read_text("a.ply", head + "9 0 2 1 3 -1 2 4 3 5\n").mesh;
  EXPECT_EQ(mesh.num_tris(), 4u);
  EXPECT_EQ(area_vector(mesh), (Vec3{0, 0, 2}));
}

TEST(Ply, WrongHeadersAndIndicesAreNamed) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(refusal("a.ply", head + face + "0 0\n1 0\n0 1\n3 0 1 2\n").find("lack"),
            std::string::npos);
  const std::string full = head + "property float z\n" + face + "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_NE(refusal("a.ply", full + "3 0 1 3\n").find("uses vertex 3"), std::string::npos);
  EXPECT_NE(refusal("a.ply", full + "3 0 1 -1\n").find("uses vertex -1"), std::string::npos);
  EXPECT_NE(refusal("a.ply", full + "2 0 1\n").find("three or more"), std::string::npos);
  EXPECT_NE(refusal("a.ply", "ply\nformat text 1.0\n").find("unknown format"), std::string::npos);
}

TEST(Polygons, ConcaveOnesKeepTheirShape) {
  // A comb, a polygon with a bridge to a square hole, and a convex decagon.
  const std::string comb =
      "v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 3 0\nv 4 1 0\nv 3 1 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\n"
      "v 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8 9 10 11 12\n";
  const TriMesh comb_mesh = read_text("a.obj", comb).mesh;
  EXPECT_EQ(comb_mesh.num_tris(), 10u);
  EXPECT_DOUBLE_EQ(area_vector(comb_mesh).z, 11);
  EXPECT_DOUBLE_EQ(sum_of_areas(comb_mesh), 11) << "no triangle is turned over";

  const std::string holed =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
      "f 1 2 3 4 1 5 6 7 8 5\n";
  const TriMesh holed_mesh = read_text("a.obj", holed).mesh;
  EXPECT_DOUBLE_EQ(area_vector(holed_mesh).z, 12);
  EXPECT_DOUBLE_EQ(sum_of_areas(holed_mesh), 12);
}

TEST(Polygons, ConcaveQuadsAreCutThroughTheirReflexVertex) {
  for (const char* face : {"f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"}) {
    const auto mesh =
        read_text("a.obj", std::string("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n") + face).mesh;
    EXPECT_DOUBLE_EQ(sum_of_areas(mesh), 4) << face;
  }
}

}  // namespace
}  // namespace hexwright
