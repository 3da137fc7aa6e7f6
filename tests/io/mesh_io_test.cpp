// Reading and writing hex and tet meshes: round trips, foreign files, refused files.
#include "hexwright/io/mesh_io.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/mesh/cut_hexes.h"

#include "helpers.h"
#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::labelled_box;
using test::TempFolder;

void expect_same(const HexMesh& a, const HexMesh& b, const std::string& what) {
  EXPECT_EQ(a.positions, b.positions) << what;
  EXPECT_EQ(a.hexes, b.hexes) << what;
  EXPECT_EQ(a.region, b.region) << what;
  EXPECT_TRUE(a.labels == b.labels) << what;
}

TEST(HexMeshIo, LabelsRegionsAndPositionsSurviveARoundTrip) {
  const TempFolder folder;
  const HexMesh mesh = labelled_box();
  WriteHexOptions options;
  options.fields.push_back({"quality", std::vector<double>(mesh.num_hexes(), 0.25)});
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
    for (bool write_sets : {false, true}) {
      options.write_sets = write_sets;
      write_hex_mesh(folder / name, mesh, options);
      expect_same(read_hex_mesh(folder / name), mesh, name);
    }
  }
  EXPECT_EQ(folder.num_files(), 3u);
}

TEST(HexMeshIo, BareMeshesStayBare) {
  const TempFolder folder;
  const HexMesh mesh = test::box_hex_mesh(3, 1, 1);
  for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
    write_hex_mesh(folder / name, mesh);
    const HexMesh back = read_hex_mesh(folder / name);
    expect_same(back, mesh, name);
    EXPECT_TRUE(back.region.empty()) << name;
  }
}

TEST(HexMeshIo, ContentDecidesNotTheName) {
  const TempFolder folder;
  const HexMesh mesh = labelled_box();
  write_hex_mesh(folder / "a.vtu", mesh);
  std::filesystem::rename(folder / "a.vtu", folder / "a.mesh");
  expect_same(read_hex_mesh(folder / "a.mesh"), mesh, "vtu named .mesh");
}

TEST(HexMeshIo, MeditIsToleratedInAnyOrderWithCommentsAndStrangeSections) {
  const TempFolder folder;
  const auto path =
      folder.write("a.mesh",
                   "# a comment\nMeshVersionFormatted 1 Dimension\n3\n"
                   "Normals 1\n0 0 1\nVertices 9 # nine\r\n"
                   "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n"
                   "0 1 1 0\n5 5 5 7\nRequiredVertices\n1\n9\nTriangles 1\n1 2 3 4\n"
                   "Hexahedra\n1\n1 2 3 4 5 6 7 8 42\nTetrahedra 1\n1 2 3 5 0\nEnd\n");
  const HexMesh mesh = read_hex_mesh(path);
  EXPECT_EQ(mesh.num_verts(), 9u);
  EXPECT_EQ(mesh.region[HexId(0)], 42);
  EXPECT_EQ(mesh.labels.corners, std::vector<VertId>{VertId(8)});
  EXPECT_EQ(read_tet_mesh(path).num_tets(), 1u);
}

TEST(HexMeshIo, HexesAreCutWhereTetsAreAskedFor) {
  const TempFolder folder;
  const HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  for (const char* name : {"a.vtk", "a.mesh", "a.msh", "a.vtu"}) {
    write_hex_mesh((folder / name), mesh);
    EXPECT_EQ(read_tet_mesh((folder / name)).tets, cut_hexes(mesh).tets) << name;
  }
  EXPECT_THROW(read_tet_mesh(folder.write("b.mesh",
                                          "MeshVersionFormatted 1\nDimension 3\n"
                                          "Vertices 1\n0 0 0 0\nEnd\n")),
               Error);
}

TEST(HexMeshIo, LegacyVtkTextVersions2And5GiveTheSame) {
  const TempFolder folder;
  const std::string points =
      "ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n"
      "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n";
  const std::string types =
      "CELL_TYPES 2\n11\n9\nCELL_DATA 2\nSCALARS region int 1\n"
      "LOOKUP_TABLE default\n5 6\n";
  const auto old_path =
      folder.write("old.vtk", "# vtk DataFile Version 2.0\ntitle # not a comment\n" + points +
                                  "CELLS 2 14\n8 0 1 2 3 4 5 6 7\n"
                                  "4 0 2 3 1\n" +
                                  types);
  const auto new_path = folder.write(
      "new.vtk", "# vtk DataFile Version 5.1\ntitle\n" + points +
                     "CELLS 3 12\nOFFSETS vtktypeint64\n0 8 12\nCONNECTIVITY vtktypeint64\n"
                     "0 1 2 3 4 5 6 7 0 2 3 1\n" +
                     types);
  const HexMesh mesh = read_hex_mesh(old_path);
  expect_same(read_hex_mesh(new_path), mesh, "version 5.1");
  EXPECT_EQ(mesh.region[HexId(0)], 5);
  EXPECT_EQ(mesh.hexes[HexId(0)][2], VertId(3));  // a voxel's order differs from a hexahedron's
  EXPECT_EQ(mesh.labels.quads.size(), 1u);
}

TEST(HexMeshIo, DamagedFilesAreRefusedWithPlaceAndReason) {
  const TempFolder folder;
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices\n";
  const struct {
    const char* name;
    std::string content;
    const char* where;
    const char* message;
  } cases[] = {
      {"empty.mesh", "", "empty.mesh", "empty"},
      {"count.mesh", head + "4000000000\n0 0 0 0\n", "count.mesh:4", "more than the file holds"},
      {"short.mesh", head + "2\n0 0 0 0\n1 0 0", "short.mesh:6", "truncated"},
      {"index.mesh", head + "1\n0 0 0 0\nHexahedra 1\n1 1 1 1 1 1 1 2 0\n", "index.mesh:7",
       "does not exist"},
      {"nan.mesh", head + "1\n0 nan 0 0\n", "nan.mesh:5", "not finite"},
      {"flat.mesh", "MeshVersionFormatted 2\nDimension 2\n", "flat.mesh:2", "three-dimensional"},
      {"none.mesh", head + "1\n0 0 0 0\nEnd\n", "none.mesh", "no hexahedron"},
      {"xml.vtu", "<?xml version=\"1.0\"?>\n<VTKFile>\n<Unstr", "xml.vtu:3", "XML"},
      {"poly.vtu", "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>", "poly.vtu", "PolyData"},
      {"set.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "set.vtk",
       "UnstructuredGrid"},
      {"points.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n",
       "points.vtk:4", "UNSTRUCTURED_GRID"},
      {"huge.vtk",
       "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
       "POINTS 6148914691236517206 double\n",
       "huge.vtk:5", "more values"},
      {"what.dat", "hello\n", "what.dat", "format"}};
  for (const auto& c : cases) {
    try {
      read_hex_mesh(folder.write(c.name, c.content));
      ADD_FAILURE() << c.name << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << c.name;
      EXPECT_TRUE(error.where().ends_with(c.where)) << error.what();
      EXPECT_NE(std::string(error.what()).find(c.message), std::string::npos) << error.what();
    }
  }
}

TEST(HexMeshIo, WhatCannotBeWrittenIsRefusedAndLeavesNothing) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  WriteHexOptions options;
  options.fields.push_back({"short", {}});
  EXPECT_THROW(write_hex_mesh(folder / "a.vtu", mesh, options), Error);
  options.write_sets = true;
  for (const char* name : {"", "a b", "a/b", "region", "patch"}) {
    options.fields = {{name, {1}}};
    EXPECT_THROW(write_hex_mesh(folder / "a.vtkhdf", mesh, options), Error) << name;
  }
  options.fields = {{"twice", {1}}, {"twice", {2}}};
  EXPECT_THROW(write_hex_mesh(folder / "a.vtkhdf", mesh, options), Error);
  EXPECT_THROW(write_hex_mesh(folder / "a.xyz", mesh), Error);
  EXPECT_THROW(write_hex_mesh(folder / "no_folder/a.vtu", mesh), Error);
  mesh.hexes[HexId(0)][3] = VertId(8);
  EXPECT_THROW(write_hex_mesh(folder / "a.vtu", mesh), Error);
  EXPECT_EQ(folder.num_files(), 0u);
}

TEST(HexMeshIo, SharedMeshesRead) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  const auto data = test::shared_dir() / "data";
  EXPECT_EQ(read_hex_mesh(data / "hex/hybridoctree_bone.vtk").num_hexes(), 8619u);
  EXPECT_EQ(read_hex_mesh(data / "hex/hybridoctree_dtorus.vtk").num_hexes(), 15872u);
  EXPECT_EQ(read_hex_mesh(data / "hex/hybridoctree_retinal.vtk").num_hexes(), 15950u);
  EXPECT_EQ(read_tet_mesh(data / "polycube/synth_L_object.mesh").num_tets(), 3750u);
  EXPECT_EQ(read_tet_mesh(data / "polycube/robustpolycube_B0_polycube.mesh").num_tets(), 2188u);
}

}  // namespace
}  // namespace hexwright
