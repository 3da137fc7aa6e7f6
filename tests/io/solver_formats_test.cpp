// Rules of the formats of solvers that their readers rely on.
#include "io/solver/solver_formats.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

std::vector<int> label_list(const std::string& text) {
  std::istringstream in(text.substr(text.find("\n\n") + 2));
  std::size_t count = 0;
  char bracket = 0;
  in >> count >> bracket;
  std::vector<int> labels(count);
  for (int& label : labels) in >> label;
  return labels;
}

/// A box whose hexes come in a shuffled order.
HexMesh shuffled_box() {
  HexMesh mesh = test::box_hex_mesh(3, 4, 2);
  std::mt19937 random(5);
  std::shuffle(mesh.hexes.raw().begin(), mesh.hexes.raw().end(), random);
  return mesh;
}

TEST(OpenFoam, InnerFacesAreInUpperTriangularOrder) {
  const TempFolder folder;
  write_hex_mesh(folder / "polyMesh", shuffled_box());
  const auto owner = label_list(test::slurp(folder / "polyMesh/owner"));
  const auto neighbour = label_list(test::slurp(folder / "polyMesh/neighbour"));
  ASSERT_GT(neighbour.size(), 10u);
  for (std::size_t f = 0; f < neighbour.size(); ++f) {
    EXPECT_LT(owner[f], neighbour[f]);
    if (f > 0) {
      EXPECT_LT((std::pair{owner[f - 1], neighbour[f - 1]}), (std::pair{owner[f], neighbour[f]}));
    }
  }
}

TEST(OpenFoam, FacesWithoutALabelHaveAPatch) {
  const TempFolder folder;
  HexMesh mesh = shuffled_box();
  write_hex_mesh(folder / "polyMesh", mesh);
  EXPECT_NE(test::slurp(folder / "polyMesh/boundary").find("unlabeled\n"), std::string::npos);
  mesh.labels.quads.push_back(
      {face_verts(mesh, compute_hex_neighbors(mesh).boundary[3]), PatchId(0)});
  mesh.labels.patch_names = {"unlabeled"};
  write_hex_mesh(folder / "polyMesh", mesh);
  const std::string boundary = test::slurp(folder / "polyMesh/boundary");
  EXPECT_NE(boundary.find(" unlabeled\n"), std::string::npos);
  EXPECT_NE(boundary.find(" unlabeled_\n"), std::string::npos);
}

TEST(OpenFoam, TypesFollowFromNamesAndGroupsAreKept) {
  const TempFolder folder;
  HexMesh mesh = test::named_box();
  mesh.labels.patch_names[PatchId(0)] = "symmetry_low";
  write_hex_mesh(folder / "polyMesh", mesh);
  const std::string boundary = test::slurp(folder / "polyMesh/boundary");
  const auto entry = [&](const std::string& name) {
    const auto begin = boundary.find("    " + name + "\n");
    return boundary.substr(begin, boundary.find('}', begin) - begin);
  };
  EXPECT_NE(entry("wall.1").find("type        wall;"), std::string::npos);
  EXPECT_NE(entry("wall.1").find("inGroups    1(wall);"), std::string::npos);
  EXPECT_NE(entry("symmetry_low").find("type        symmetry;"), std::string::npos);
  EXPECT_NE(entry("Inlet").find("type        patch;"), std::string::npos);
}

TEST(OpenFoam, AFolderThatHoldsOtherFilesIsLeftAlone) {
  const TempFolder folder;
  const HexMesh mesh = shuffled_box();
  write_hex_mesh(folder / "polyMesh", mesh);
  write_hex_mesh(folder / "polyMesh", mesh);  // its own files are replaced
  EXPECT_EQ(folder.num_files(), 1u);
  std::ofstream(folder / "polyMesh/notes.txt") << "mine";
  EXPECT_THROW(write_hex_mesh(folder / "polyMesh", mesh), Error);
  EXPECT_EQ(test::slurp(folder / "polyMesh/notes.txt"), "mine");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(OpenFoam, QuadsBetweenHexesAreFaceZones) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  const auto quad = face_verts(mesh, {HexId(0), 1});
  mesh.labels.quads.push_back({quad, PatchId(0)});
  mesh.labels.patch_names = {"interface"};
  write_hex_mesh(folder / "polyMesh", mesh);
  const std::string zones = test::slurp(folder / "polyMesh/faceZones");
  EXPECT_NE(zones.find("interface\n{"), std::string::npos);
  EXPECT_NE(zones.find("flipMap List<bool>\n1\n(\n0\n"), std::string::npos);
  EXPECT_EQ(test::slurp(folder / "polyMesh/boundary").find("interface"), std::string::npos);
  std::reverse(mesh.labels.quads[0].verts.begin(), mesh.labels.quads[0].verts.end());
  write_hex_mesh(folder / "polyMesh", mesh);
  EXPECT_NE(test::slurp(folder / "polyMesh/faceZones").find("flipMap List<bool>\n1\n(\n1\n"),
            std::string::npos);
}

TEST(OpenFoam, FacesOfZonesAreThoseOfTheQuads) {
  const TempFolder folder;
  HexMesh mesh = shuffled_box();
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  HexFace inner;
  for (HexId h : mesh.hexes.ids())
    if (neighbors.neighbor[h][0].is_valid()) inner = {h, 0};
  const HexId other = neighbors.neighbor[inner.hex][0];
  mesh.labels.quads.push_back({face_verts(mesh, inner), PatchId(0)});
  write_hex_mesh(folder / "polyMesh", mesh);
  const std::string zones = test::slurp(folder / "polyMesh/faceZones");
  const auto at = zones.find("List<label>\n1\n(\n");
  ASSERT_NE(at, std::string::npos);
  const auto face = std::size_t(std::stoi(zones.substr(at + 16)));
  const auto owner = label_list(test::slurp(folder / "polyMesh/owner"));
  const auto neighbour = label_list(test::slurp(folder / "polyMesh/neighbour"));
  ASSERT_LT(face, neighbour.size());
  EXPECT_EQ(owner[face], std::min(inner.hex, other).value());
  EXPECT_EQ(neighbour[face], std::max(inner.hex, other).value());
}

TEST(Nastran, NumbersFillTheirFields) {
  const TempFolder folder;
  HexMesh mesh = test::named_box();
  for (Vec3& p : mesh.positions) p = p * -1e-105 + Vec3{1.0 / 3, -1e250, 0};
  write_hex_mesh(folder / "a.bdf", mesh);
  std::istringstream in(test::slurp(folder / "a.bdf"));
  bool has_grid = false;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '$') continue;
    EXPECT_LE(line.size(), 73u) << line;
    if (!line.starts_with("GRID*")) continue;
    has_grid = true;
    EXPECT_EQ(line.size(), 72u) << line;
    EXPECT_NE(line.substr(40, 16).find('.'), std::string::npos) << "a real has a point";
  }
  EXPECT_TRUE(has_grid);
}

TEST(SolverFormats, QuadsThatAreNoFaceAreRefused) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.labels.quads.push_back({{VertId(0), VertId(1), VertId(6), VertId(7)}, PatchId(0)});
  for (const char* format : {"abaqus", "exodus", "mfem", "nastran", "su2", "openfoam"}) {
    WriteHexOptions options;
    options.format = format;
    EXPECT_THROW(write_hex_mesh(folder / "a", mesh, options), Error) << format;
  }
  EXPECT_EQ(folder.num_files(), 0u);
}

TEST(SolverFormats, FacesOfThreeHexesAreRefusedWhereEveryFaceHasItsPlace) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (int copy = 0; copy < 2; ++copy) mesh.hexes.push_back(mesh.hexes[HexId(0)]);
  for (const char* format : {"mfem", "su2", "openfoam"}) {
    WriteHexOptions options;
    options.format = format;
    EXPECT_THROW(write_hex_mesh(folder / "a", mesh, options), Error) << format;
  }
  EXPECT_EQ(folder.num_files(), 0u);
}

TEST(SolverFormats, UnknownOnesAreNamed) {
  WriteHexOptions options;
  options.format = "nonsense";
  try {
    write_hex_mesh("a.vtu", test::box_hex_mesh(1, 1, 1), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("gmsh2"), std::string::npos);
  }
}

TEST(SolverFormats, APatchCalledAPointIsNoGroupOfCgns) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.labels.quads.push_back(
      {face_verts(mesh, compute_hex_neighbors(mesh).boundary[0]), PatchId(0)});
  mesh.labels.patch_names = {"."};
  const auto changed = write_hex_mesh(folder / "a.cgns", mesh).changed_names;
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].written, "._2");
}

TEST(SolverFormats, AQuadThatIsNoFaceIsNamed) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.labels.quads.push_back({{VertId(0), VertId(1), VertId(2), VertId(7)}, PatchId(0)});
  try {
    write_hex_mesh(folder / "a.exo", mesh);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("labelled quad 0 is no face"), std::string::npos)
        << error.what();
  }
}

TEST(SolverFormats, EveryWriterLooksAtTheCallersFlag) {
  const HexMesh mesh = test::box_hex_mesh(12, 12, 12);
  const io::NodeTable nodes(mesh, 8);
  const SetTable table = make_set_table(mesh);
  const std::atomic<bool> is_cancelled = true;
  const CancelScope scope(&is_cancelled);
  for (auto* write : {io::abaqus_text, io::ansys_text, io::cgns_bytes, io::exodus_bytes,
                      io::med_bytes, io::mfem_text, io::nastran_text})
    EXPECT_THROW(write(nodes, table), Error);
  for (auto* write : {io::lsdyna_text, io::su2_text}) EXPECT_THROW(write(mesh, table), Error);
  EXPECT_THROW(io::vtkhdf_bytes(nodes, table, {}), Error);
  EXPECT_THROW(io::openfoam_files(mesh, table), Error);
}

}  // namespace
}  // namespace hexwright
