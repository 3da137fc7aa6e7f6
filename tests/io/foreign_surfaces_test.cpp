// Surfaces of VTK, Gmsh, Nastran and 3MF files: names, places and refusals.
#include <map>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/surface_io.h"

#include "io/surface_samples.h"
#include "io/temp_folder.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

using test::TempFolder;

/// Triangles by the name of their group.
std::map<std::string, std::size_t> sizes(const TriMesh& surface) {
  std::map<std::string, std::size_t> found;
  for (TriId t : surface.tris.ids())
    ++found[surface.group.empty() ? "" : surface.group_names[std::size_t(surface.group[t])]];
  return found;
}

std::string refusal(const std::string& name, std::string text, const std::string& find,
                    const std::string& replace) {
  const TempFolder folder;
  const auto at = text.find(find);
  EXPECT_NE(at, std::string::npos) << find;
  text.replace(at, find.size(), replace);
  try {
    read_surface(folder.write(name, text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return "accepted";
}

void expect_in(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(ForeignSurfaces, NamesOfEveryFormatArrive) {
  const TempFolder folder;
  using Sizes = std::map<std::string, std::size_t>;
  for (const auto& [name, text, expected] :
       std::vector<std::tuple<std::string, std::string, Sizes>>{
           {"a.msh", test::kGmshTetrahedron, {{"base", 1}, {"roof", 3}}},
           {"a.vtk", test::kVtkTetrahedron, {{"base", 1}, {"label_5", 3}}},
           {"a.vtp", test::kVtpTetrahedron, {{"RegionId_4", 1}, {"RegionId_5", 3}}},
           {"a.bdf", test::kNastranTetrahedron, {{"base", 1}, {"roof", 3}}}}) {
    const SurfaceFile file = read_surface(folder.write(name, text));
    EXPECT_EQ(sizes(file.mesh), expected) << name;
    EXPECT_NEAR(enclosed_volume(file.mesh), 1.0 / 6, 1e-12) << name;
    EXPECT_TRUE(file.warnings.empty()) << name << ": " << file.warnings[0];
  }
}

TEST(ForeignSurfaces, PropertiesAreCalledAsOtherProgramsNameThem) {
  const TempFolder folder;
  for (const char* comment : {"$ANSA_NAME_COMMENT;4;PSHELL;front side;;NO;NO;",
                              "$ Femap with NX Nastran Property 4 : front side",
                              "$HMNAME COMP                   4\"front side\""}) {
    std::string text = test::kNastranTetrahedron;
    const auto begin = text.find("$HMNAME COMP"), end = text.find("$ Elements and");
    text.replace(begin, end - begin, std::string(comment) + "\n");
    const auto found = sizes(read_surface(folder.write("a.nas", text)).mesh);
    EXPECT_EQ(found.begin()->first, "front side") << comment;
  }
}

TEST(ForeignSurfaces, ObjectsOf3mfAreWhereTheyAreBuilt) {
  const TempFolder folder;
  const std::string zip = test::zip_of({{"3D/a.model", test::k3mfModel}});
  const SurfaceFile file = read_surface(folder.write("a.3mf", zip));
  EXPECT_EQ(sizes(file.mesh), (std::map<std::string, std::size_t>{{"bolt", 8}}));
  EXPECT_NEAR(enclosed_volume(file.mesh), 2.0 / 6, 1e-12) << "a mirrored object is turned outwards";
  EXPECT_EQ(bounding_box(file.mesh).hi.x, 9);
  std::string unnamed = test::k3mfModel;
  unnamed.replace(unnamed.find(" name=\"bolt\""), 12, "");
  const auto found =
      sizes(read_surface(folder.write("b.3mf", test::zip_of({{"a.model", unnamed}}))).mesh);
  EXPECT_EQ(found, (std::map<std::string, std::size_t>{{"object_1", 4}, {"pair", 4}}));
}

TEST(ForeignSurfaces, WhatCannotBeReadIsNamedWithItsPlace) {
  const std::string nastran = test::kNastranTetrahedron;
  expect_in(refusal("a.bdf", nastran, "CTRIA3,2,5,1,2,7", "CTRIA3,2,5,1,2,8"),
            "a.bdf:11: the shell uses grid point 8");
  expect_in(refusal("a.bdf", nastran, "GRID,2,,1.", "GRID,2,3,1."),
            "a.bdf:16: the grid point lies in");
  expect_in(refusal("a.bdf", nastran, "GRID,2,,1.+0", "GRID,2,,1.x"), "a.bdf:16: ");
  expect_in(refusal("a.bdf", nastran, "GRID,2,", "GRID,1,"), "grid point 1 comes twice");
  expect_in(refusal("a.bdf", nastran, "CTRIA3,2,5,1,2,7", "CTRIA3,2,5,1,,7"),
            "a.bdf:11: expected the number of a grid point");
  expect_in(refusal("a.msh", test::kGmshTetrahedron, "2 3 7\n", "2 3 9\n"), "uses node 9");
  expect_in(refusal("a.vtk", test::kVtkTetrahedron, "3 1 2 3", "3 1 2 4"),
            "cell 2: it uses vertex 4 of 4");
  expect_in(refusal("a.vtp", test::kVtpTetrahedron, "3 6 9 12", "3 6 9 99"),
            "cell 3: its vertices lie outside");
  expect_in(refusal("a.vtp", test::kVtpTetrahedron, "3 6 9 12", "3 5 9 12"),
            "cell 1: it has 2 vertices");
}

/// A strip of lines and a vertex too, whose numbers have names of their own.
constexpr const char* kQuadraticVtk =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 2\n"
    "plate 1 2 int\n4 2\naxis 1 2 int\n6 2\nPOINTS 9 float\n0 0 0 2 0 0 2 2 0 0 2 0 1 0 0 2 1 0 "
    "1 2 0 0 1 0 1 1 0\nCELLS 4 29\n8 0 1 2 3 4 5 6 7\n9 0 1 2 3 4 5 6 7 8\n6 0 1 2 4 5 8\n"
    "2 0 1\nCELL_TYPES 4\n23\n28\n22\n3\nCELL_DATA 4\nSCALARS patch int 1\nLOOKUP_TABLE default\n"
    "4 4 5 6\n";

TEST(ForeignSurfaces, CellsOfVtkAreReadByTheirCorners) {
  const TempFolder folder;
  const SurfaceFile file = read_surface(folder.write("a.vtk", kQuadraticVtk));
  EXPECT_EQ(sizes(file.mesh), (std::map<std::string, std::size_t>{{"plate", 4}, {"patch_5", 1}}));
  EXPECT_EQ(file.mesh.group_names, (std::vector<std::string>{"plate", "patch_5"}))
      << "what is left out has no name";
  ASSERT_EQ(file.warnings.size(), 1u);
  expect_in(file.warnings[0], "1 cells are no polygons");
  expect_in(refusal("a.vtk", kQuadraticVtk, "8 0 1 2 3 4 5 6 7\n9 0 1 2 3 4 5 6 7 8",
                    "9 0 1 2 3 4 5 6 7 8\n8 0 1 2 3 4 5 6 7"),
            "cell 0: it has 9 vertices instead of 8");
}

TEST(ForeignSurfaces, SolidsOfGmshAreToldWhateverTheirOrder) {
  const TempFolder folder;
  for (const auto& [type, num_nodes] :
       std::vector<std::pair<int, int>>{{4, 4}, {5, 8}, {12, 27}, {17, 20}}) {
    std::string text = test::kGmshTetrahedron, solid = "6 " + std::to_string(type) + " 2 9 1";
    for (int k = 0; k < num_nodes; ++k) solid += " 1";
    text.replace(text.find("$Elements\n5"), 11, "$Elements\n6");
    text.insert(text.find("$EndElements"), solid + "\n");
    const SurfaceFile file = read_surface(folder.write("a.msh", text));
    ASSERT_EQ(file.warnings.size(), 1u) << type;
    expect_in(file.warnings[0], "1 elements are no triangles or quads");
  }
}

TEST(ForeignSurfaces, SupportsOf3mfAreNotBuilt) {
  const TempFolder folder;
  for (const char* type : {"support", "solidsupport", "other"}) {
    std::string text = test::k3mfModel;
    const std::string object = "<object id=\"2\"";
    text.replace(text.find(object), object.size(), object + " type=\"" + std::string(type) + "\"");
    const auto zip = test::zip_of({{"a.model", text}});
    EXPECT_EQ(read_surface(folder.write("a.3mf", zip)).mesh.num_tris(), 4u) << type;
  }
}

// A few hundred bytes must not take all memory.
TEST(ForeignSurfaces, CopiesOf3mfObjectsAreBounded) {
  std::string model =
      "<model><resources><object id=\"0\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
      "</vertices><triangles>";
  for (int t = 0; t < 1000; ++t) model += "<triangle v1=\"0\" v2=\"0\" v3=\"0\"/>";
  model += "</triangles></mesh></object>";
  for (int level = 1; level <= 4; ++level) {
    model += "<object id=\"" + std::to_string(level) + "\"><components>";
    for (int k = 0; k < 16; ++k)
      model += "<component objectid=\"" + std::to_string(level - 1) + "\"/>";
    model += "</components></object>";
  }
  model += "</resources><build><item objectid=\"4\"/></build></model>";
  const std::string message = refusal("a.3mf", test::zip_of({{"3D/a.model", model}}), "PK", "PK");
  expect_in(message, "3D/a.model: object 0: with its copies");
  expect_in(message, "give each object once");
}

TEST(ForeignSurfaces, PositionsOf3mfMustBeFinite) {
  std::string text = test::k3mfModel;
  text.replace(text.find("x=\"1\""), 5, "x=\"inf\"");
  expect_in(refusal("a.3mf", test::zip_of({{"3D/a.model", text}}), "PK", "PK"),
            "3D/a.model: vertex 1: a coordinate is not finite");
}

TEST(ForeignSurfaces, WhatPacksA3mfFileIsSaid) {
  const std::string zip = test::zip_of({{"3D/a.model", test::k3mfModel}});
  const std::size_t entry = zip.find("PK\x01\x02");
  std::string encrypted = zip, packed = zip, large = zip;
  encrypted[entry + 8] = 1;
  expect_in(refusal("a.3mf", encrypted, "PK", "PK"), "'3D/a.model': it is encrypted");
  packed[entry + 10] = 14;  // LZMA
  const std::string method = refusal("a.3mf", packed, "PK", "PK");
  expect_in(method, "'3D/a.model': it is packed by a method other than deflate");
  EXPECT_EQ(method.find("encrypted"), std::string::npos) << method;
  large[entry + 10] = 8;
  large.replace(entry + 24, 4, "\xff\xff\xff\xff");  // the size stands behind the name
  large[entry + 30] = 12;
  std::string extra;
  io::store(extra, std::uint16_t{1}, io::ByteOrder::Little);
  io::store(extra, std::uint16_t{8}, io::ByteOrder::Little);
  io::store(extra, std::uint64_t{1} << 33, io::ByteOrder::Little);
  large.insert(entry + 46 + std::string("3D/a.model").size(), extra);
  expect_in(refusal("a.3mf", large, "PK", "PK"), "'3D/a.model': it has more than 4 GB");
}

TEST(ForeignSurfaces, Damaged3mfFilesAreRefusedWithThePart) {
  const TempFolder folder;
  const auto refused = [&](const std::string& find, const std::string& replace) {
    std::string text = test::k3mfModel;
    text.replace(text.find(find), find.size(), replace);
    const std::string zip = test::zip_of({{"3D/a.model", text}});
    return refusal("a.3mf", zip, "PK", "PK");
  };
  expect_in(refused("v3=\"1\"", "v3=\"4\""), "3D/a.model: triangle 0: it uses vertex 4 of 4");
  expect_in(refused("x=\"1\"", "x=\"1m\""), "3D/a.model: vertex 1: its 'x' is no number");
  expect_in(refused("<item objectid=\"2\"", "<item objectid=\"3\""), "it names object '3'");
  expect_in(refused("<component objectid=\"1\"", "<component objectid=\"2\""), "too many times");
  expect_in(refused("1 9 0 0", "1 9 0"), "fewer than twelve numbers");
  expect_in(refused("</model>", "</modal>"), "3D/a.model: the XML is damaged");
  const std::string zip = test::zip_of({{"3D/a.model", test::k3mfModel}});
  expect_in(refusal("a.3mf", zip, "millimeter", "centimeter"), "'3D/a.model': it is damaged");
  expect_in(refusal("a.3mf", test::zip_of({{"readme.txt", "x"}}), "PK", "PK"),
            "ZIP archive without a 3MF model");
}

}  // namespace
}  // namespace hexwright
