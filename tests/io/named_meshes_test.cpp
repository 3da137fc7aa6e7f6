// Named sets come back from every format that is read, and from files of other programs.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/mesh/hex_shape.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;
using Points = std::multiset<std::array<double, 3>>;

/// Name of a set -> the centres of its elements, whatever their order and numbers. All hexes must
/// be unit cubes. `with_edges`: curves and corners too.
std::map<std::string, Points> centres_by_name(const HexMesh& mesh, bool with_edges) {
  EXPECT_FALSE(mesh.find_problem());
  for (HexId h : mesh.hexes.ids()) EXPECT_NEAR(hex_volume(mesh.corners(h)), 1, 1e-9);
  std::map<std::string, Points> sets;
  const SetTable table = make_set_table(mesh);
  const auto add = [&](const NamedSet& set, const auto& verts_of) {
    for (std::size_t i : set.members) {
      const auto verts = verts_of(i);
      Vec3 sum;
      for (VertId v : verts) sum += mesh.positions[v];
      sum = sum / double(verts.size());
      for (int axis = 0; axis < 3; ++axis) sum[axis] = std::round(sum[axis] * 1e6) / 1e6 + 0.0;
      sets[set.name].insert({sum.x, sum.y, sum.z});
    }
  };
  for (const NamedSet& set : table.regions)
    add(set, [&](std::size_t h) { return mesh.hexes[HexId(h)]; });
  for (const NamedSet& set : table.patches)
    add(set, [&](std::size_t q) { return mesh.labels.quads[q].verts; });
  if (with_edges) {
    for (const NamedSet& set : table.curves)
      add(set, [&](std::size_t e) { return mesh.labels.edges[e].verts; });
    for (const NamedSet& set : table.corners)
      add(set, [&](std::size_t c) { return std::array{mesh.labels.corners[c]}; });
  }
  return sets;
}

TEST(NamedMeshes, ComeBackFromEveryFormatThatIsRead) {
  const TempFolder folder;
  const HexMesh mesh = test::named_box();
  for (const char* format : {"vtu", "vtk", "medit", "gmsh", "gmsh2", "abaqus", "exodus", "mfem"}) {
    WriteHexOptions options;
    options.format = format;
    const auto path =
        folder / (std::string("a.") + (format == std::string("abaqus") ? "inp" : "x"));
    const auto changed = write_hex_mesh(path, mesh, options).changed_names;
    const bool with_edges = format != std::string("mfem");
    std::map<std::string, Points> expected;
    for (auto& [name, points] : centres_by_name(mesh, with_edges)) {
      const auto as_written = std::find_if(changed.begin(), changed.end(),
                                           [&](const auto& c) { return c.given == name; });
      expected[as_written == changed.end() ? name : as_written->written] = points;
    }
    EXPECT_EQ(centres_by_name(read_hex_mesh(path), with_edges), expected) << format;
  }
}

TEST(NamedMeshes, NamesMayHoldTheWordsOfTheFormat) {
  const TempFolder folder;
  HexMesh mesh = test::named_box();
  mesh.region_names[0] = "Vertices";
  mesh.labels.patch_names[PatchId(0)] = "End # Hexahedra";
  write_hex_mesh(folder / "a.mesh", mesh);
  EXPECT_EQ(read_hex_mesh(folder / "a.mesh").labels, mesh.labels);
  EXPECT_EQ(read_hex_mesh(folder / "a.mesh").region_names, mesh.region_names);
}

TEST(NamedMeshes, NamesStayWithTheirNumbersInOwnFormats) {
  const TempFolder folder;
  HexMesh mesh = test::named_box();
  write_hex_mesh(folder / "a.mesh", mesh);
  const HexMesh back = read_hex_mesh(folder / "a.mesh");
  EXPECT_EQ(back.labels, mesh.labels);
  EXPECT_EQ(back.region_names, mesh.region_names);
  mesh.labels.patch_names = {"inlet", "outlet", "outer_wall", "wall.1", "wall.2", ""};
  mesh.labels.curve_names = {"rim", "edge", ""};
  mesh.region_names = {"steel", "", "copper"};
  for (const char* name : {"a.vtu", "a.vtk"}) {
    write_hex_mesh(folder / name, mesh);
    EXPECT_EQ(read_hex_mesh(folder / name).labels, mesh.labels) << name;
    EXPECT_EQ(read_hex_mesh(folder / name).region_names, mesh.region_names) << name;
  }
}

// Of other programs: tags in any order, an element in no group, elements of other kinds.
TEST(Gmsh, ForeignFilesOfBothVersionsRead) {
  const TempFolder folder;
  const std::string nodes =
      "10 0 0 0\n20 1 0 0\n30 1 1 0\n40 0 1 0\n50 0 0 1\n60 1 0 1\n70 1 1 1\n80 0 1 1\n90 9 9 9\n";
  const std::string names =
      "$PhysicalNames\n3\n2 7 \"in let\"\n3 4 \"solid # 1\"\n1 3 \"rim\"\n$EndPhysicalNames\n";
  const std::string version2 =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nmade by hand\n"
      "$EndComments\n" +
      names + "$Nodes\n9\n" + nodes +
      "$EndNodes\n$Elements\n6\n1 3 2 7 1 10 20 30 40\n"
      "2 3 2 0 2 50 60 70 80\n3 2 2 7 1 10 20 30\n4 1 2 3 1 10 20\n"
      "5 5 2 4 1 10 20 30 40 50 60 70 80\n6 3 2 7 1 10 20 70 80\n"
      "$EndElements\n";
  const HexMesh mesh = read_hex_mesh(folder.write("a.msh", version2));
  EXPECT_EQ(mesh.num_verts(), 8u) << "node 90 is used by nothing";
  ASSERT_EQ(mesh.num_hexes(), 1u);
  ASSERT_EQ(mesh.labels.quads.size(), 2u) << "the third is no face";
  const SetTable table = make_set_table(mesh);
  EXPECT_EQ(table.regions[0].name, "solid # 1");
  EXPECT_EQ(table.patches[0].name, "PATCH_NONE");
  EXPECT_EQ(table.patches[1].name, "in let");
  EXPECT_EQ(table.curves[0].name, "rim");
  const auto side = find_quad_sides(mesh);
  for (std::size_t q = 0; q < 2; ++q)
    EXPECT_EQ(mesh.labels.quads[q].verts, face_verts(mesh, side[q]));

  const std::string version4 =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
      "$Entities\n0 0 1 1\n5 0 0 0 1 1 0 2 7 8 0\n6 0 0 0 1 1 1 1 4 2 5 -5\n$EndEntities\n"
      "$Nodes\n2 8 10 80\n2 5 0 4\n10\n20\n30\n40\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "3 6 0 4\n50\n60\n70\n80\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n$EndNodes\n"
      "$Elements\n2 2 1 2\n2 5 3 1\n1 10 20 30 40\n3 6 5 1\n2 10 20 30 40 50 60 70 80\n"
      "$EndElements\n";
  const HexMesh four = read_hex_mesh(folder.write("b.msh", version4));
  const SetTable sets = make_set_table(four);
  EXPECT_EQ(sets.regions[0].name, "solid # 1");
  EXPECT_EQ(sets.patches[0].name, "in let");
}

// Numbers are indices of names in memory: tags that are too large for it must not cost the names.
TEST(Gmsh, NamesOfGroupsWithLargeTagsAreKept) {
  const TempFolder folder;
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n2\n2 5000000 \"inlet\"\n2 5000001 \"outlet\"\n$EndPhysicalNames\n"
      "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
      "$EndNodes\n$Elements\n4\n1 3 2 5000000 1 1 2 3 4\n2 3 2 5000001 2 5 6 7 8\n"
      "3 3 2 2000000000 3 1 2 6 5\n4 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";
  const SetTable table = make_set_table(read_hex_mesh(folder.write("a.msh", text)));
  ASSERT_EQ(table.patches.size(), 3u);
  EXPECT_EQ(table.patches[0].name, "inlet");
  EXPECT_EQ(table.patches[1].name, "outlet");
  EXPECT_EQ(table.patches[2].name, "PATCH_2");
}

TEST(Gmsh, EntitiesAreGroupsWhereThereAreNone) {
  const TempFolder folder;
  HexMesh mesh = test::labelled_box();
  WriteHexOptions options;
  options.format = "gmsh2";
  write_hex_mesh(folder / "a.msh", mesh, options);
  std::string text = test::slurp(folder / "a.msh");
  const auto begin = text.find("$PhysicalNames"), end = text.find("$Nodes");
  text.erase(begin, end - begin);
  std::istringstream in(text);
  std::string without, line;
  for (bool is_element = false; std::getline(in, line); without += line + "\n") {
    is_element = line == "$Elements" || (is_element && line != "$EndElements");
    std::istringstream fields(line);
    std::string id, type, tags, physical, rest;
    if (is_element && fields >> id >> type >> tags >> physical && tags == "2") {
      std::getline(fields, rest);
      line = id + " " + type + " 2 0" + rest;
    }
  }
  const HexMesh back = read_hex_mesh(folder.write("b.msh", without));
  EXPECT_EQ(make_set_table(back).patches.size(), 7u);
  EXPECT_EQ(make_set_table(back).regions.size(), 3u);
}

TEST(Gmsh, DamageIsRefusedWithTheLine) {
  const TempFolder folder;
  write_hex_mesh(folder / "a.msh", test::named_box());
  const std::string text = test::slurp(folder / "a.msh");
  for (std::size_t length = 0; length < text.size(); length += 7) {
    try {
      read_hex_mesh(folder.write("b.msh", text.substr(0, length)));
      // What follows the last section may be missing.
      EXPECT_GT(length, text.rfind("$EndElements")) << length;
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::BadFile) << error.what();
    }
  }
  EXPECT_THROW(read_hex_mesh(folder.write("c.msh", "$MeshFormat\n4.1 1 8\n")), Error);
  EXPECT_THROW(read_hex_mesh(folder.write("d.msh", "$MeshFormat\n1.0 0 8\n")), Error);
}

constexpr const char* kForeignInp = R"(** by hand
*Heading
 a title
*Node
 1, 0., 0., 0.
 2, 1., 0., 0.
 3, 1., 1., 0.
 4, 0., 1., 0.
 5, 0., 0., 1.
 6, 1., 0., 1.
 7, 1., 1., 1.
 8, 0., 1., 1.
 9, 2., 0., 0.
10, 2., 1., 0.
11, 2., 0., 1.
12, 2., 1., 1.
*ELEMENT, type=c3d8r
7, 1, 2, 3, 4,
   5, 6, 7, 8
8, 2, 9, 10, 3, 6, 11, 12, 7
*Elset, elset="left part"
7,
*Elset, elset=Right, generate
8, 8, 1
*Elset, elset=tops
Right, left part
*Nset, nset=corners
1, 9
*Surface, type=element, name=Top
tops, S2
*Surface, name=ends
7, s6
8, S4
*Solid Section, elset="left part", material=steel
*Solid Section, elset=right, material=copper
*Step
*End Step
)";

TEST(Abaqus, ForeignFilesRead) {
  const TempFolder folder;
  const HexMesh mesh = read_hex_mesh(folder.write("a.inp", kForeignInp));
  ASSERT_EQ(mesh.num_hexes(), 2u);
  const SetTable table = make_set_table(mesh);
  ASSERT_EQ(table.regions.size(), 2u);
  EXPECT_EQ(table.regions[0].name, "left part");
  EXPECT_EQ(table.regions[1].name, "Right");
  ASSERT_EQ(table.patches.size(), 2u);
  EXPECT_EQ(table.patches[0].name, "Top");
  EXPECT_EQ(table.patches[1].name, "ends");
  for (std::size_t q : table.patches[0].members)
    for (VertId v : mesh.labels.quads[q].verts) EXPECT_EQ(mesh.positions[v].z, 1);
  EXPECT_EQ(mesh.labels.corners, (std::vector{VertId(0), VertId(8)}));
}

/// As a program for parts and assemblies writes it: sets of the assembly, surfaces of internal
/// sets.
constexpr const char* kAssemblySets = R"(*Nset, nset=_picked, internal, instance=Part-1-1, generate
1, 4, 1
*Nset, nset=front, instance=Part-1-1
1, 2, 9
*Elset, elset=_Top_S2, internal, instance=Part-1-1, generate
7, 8, 1
*Surface, type=ELEMENT, name=Top
_Top_S2, S2
*Surface, type=ELEMENT, name=Skin
Part-1-1.skin, SPOS
*Surface, type=NODE, name=Tip
9, 1.
12
*Element, type=S4R, elset=shells
20, 1, 2, 3, 4
21, 2, 9, 10, 3
22, 5, 6, 7, 8
23, 1, 2, 7, 8
*Elset, elset=skin
20, 22
*Element, type=B31, elset=bars
30, 4, 3
31, 3, 10
)";

TEST(Abaqus, SetsOfAssembliesShellsAndBarsRead) {
  const TempFolder folder;
  std::string text = kForeignInp;
  const auto first = text.find("*Elset, elset=tops"), end = text.find("*Solid Section");
  text.replace(first, end - first, kAssemblySets);
  const HexMesh mesh = read_hex_mesh(folder.write("a.inp", text));
  const SetTable table = make_set_table(mesh);
  std::map<std::string, std::size_t> sizes;
  for (const auto* sets : {&table.regions, &table.patches, &table.curves, &table.corners})
    for (const NamedSet& set : *sets) sizes[set.name] = set.members.size();
  const std::map<std::string, std::size_t> expected = {
      {"left part", 1}, {"Right", 1},   // hexes
      {"Top", 2},                       // faces; shell 22 lies on one of them
      {"Skin", 1},      {"shells", 1},  // shells 20 and 21; 23 is no face
      {"front", 2},     {"bars", 2},    // edges
      {"CORNERS", 2}};                  // nodes 9 and 12 of Tip, which no edge joins
  EXPECT_EQ(sizes, expected);
}

// A long range is of the numbers that exist, of every kind of elements.
TEST(Abaqus, RangesLongerThanTheFileHoldShellsAndBars) {
  const TempFolder folder;
  std::string text = kForeignInp;
  text.insert(text.find("*Nset"),
              "*Element, type=S4\n1001, 1, 2, 3, 4\n1002, 2, 9, 10, 3\n"
              "*Element, type=B31\n2001, 4, 3\n"
              "*Elset, elset=skin, generate\n1001, 1100, 1\n"
              "*Elset, elset=rim, generate\n2001, 2999, 2\n");
  const SetTable table = make_set_table(read_hex_mesh(folder.write("a.inp", text)));
  ASSERT_EQ(table.patches.size(), 3u);
  const auto skin = std::find_if(table.patches.begin(), table.patches.end(),
                                 [](const NamedSet& set) { return set.name == "skin"; });
  ASSERT_NE(skin, table.patches.end());
  EXPECT_EQ(skin->members.size(), 2u);
  ASSERT_EQ(table.curves.size(), 1u);
  EXPECT_EQ(table.curves[0].name, "rim");
}

// In any case, though an edge joins the two.
TEST(Abaqus, ASetOfNodesCalledCornersIsCorners) {
  const TempFolder folder;
  std::string text = kForeignInp;
  text.replace(text.find("1, 9\n"), 5, "1, 2\n");
  const HexMesh mesh = read_hex_mesh(folder.write("a.inp", text));
  EXPECT_EQ(mesh.labels.corners, (std::vector{VertId(0), VertId(1)}));
  EXPECT_TRUE(mesh.labels.edges.empty());
}

TEST(Abaqus, SetsThatNameEachOtherDoNotMultiply) {
  const TempFolder folder;
  std::string text = kForeignInp;
  std::string sets = "*Elset, elset=a\n7, 8\n";
  for (int i = 0; i < 40; ++i) sets += "*Elset, elset=b\na, b\n*Elset, elset=a\nb, a, nothing\n";
  text.insert(text.find("*Nset"), sets + "*Surface, name=all\nb, S1\n");
  const SetTable table = make_set_table(read_hex_mesh(folder.write("a.inp", text)));
  ASSERT_EQ(table.patches.size(), 3u);
  EXPECT_EQ(table.patches[0].name, "all");
  EXPECT_EQ(table.patches[0].members.size(), 2u);
}

TEST(Abaqus, SidesOfNothingArePassedOver) {
  const TempFolder folder;
  std::string text = kForeignInp;
  text.replace(text.find("7, s6\n"), 6, ", s6\nnowhere, s6\n99999999999999999999, s6\n");
  const SetTable table = make_set_table(read_hex_mesh(folder.write("a.inp", text)));
  EXPECT_EQ(table.patches[1].name, "ends");
  EXPECT_EQ(table.patches[1].members.size(), 1u);
}

TEST(Abaqus, WhatCannotBeReadIsNamedWithItsLine) {
  const TempFolder folder;
  const auto refusal = [&](const std::string& find, const std::string& replace) {
    std::string text = kForeignInp;
    text.replace(text.find(find), find.size(), replace);
    try {
      read_hex_mesh(folder.write("a.inp", text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal("8, 2, 9,", "8, 2, 99,").find("a.inp:20: the element uses node 99"),
            std::string::npos);
  EXPECT_NE(refusal("   5, 6, 7, 8\n", "").find("nodes"), std::string::npos);
  EXPECT_NE(refusal(" 2, 1., 0.", " 1, 1., 0.").find("a.inp:6: node 1 comes twice"),
            std::string::npos);
  EXPECT_NE(refusal("*Step", "*Include, input=b.inp").find("included"), std::string::npos);
  EXPECT_NE(refusal("7, 1, 2", "7, x, 2").find("a.inp:18: expected an integer"), std::string::npos);
  EXPECT_NE(refusal("12, 2., 1., 1.", "12, 2., 1e999, 1.").find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace hexwright
