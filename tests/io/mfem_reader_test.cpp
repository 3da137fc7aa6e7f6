// MFEM meshes of any program: names of attributes, and what is refused.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

constexpr const char* kTwoCubes = R"(MFEM mesh v1.3

# a comment
dimension
3

elements
2
7 5 0 1 4 3 6 7 10 9
3 5 1 2 5 4 7 8 11 10

attribute_sets
2
"all"
2
3 7
"core # 1" 1 7

boundary
4
2 3 0 3 4 1
5 3 0 6 9 3
5 3 2 5 11 8
9 2 0 1 2

bdr_attribute_sets
1
"walls"
2
2
5

vertices
12
3
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
0 0 1
1 0 1
2 0 1
0 1 1
1 1 1
2 1 1

mfem_mesh_end
what follows is not the mesh's
)";

std::string refusal(const std::string& find, const std::string& replace) {
  const TempFolder folder;
  std::string text = kTwoCubes;
  text.replace(text.find(find), find.size(), replace);
  try {
    read_hex_mesh(folder.write("a.mesh", text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return "accepted";
}

TEST(Mfem, AttributesAreCalledByTheirSmallestSet) {
  const TempFolder folder;
  const HexMesh mesh = read_hex_mesh(folder.write("a.mesh", kTwoCubes));
  EXPECT_EQ(mesh.num_verts(), 12u);
  const SetTable table = make_set_table(mesh);
  ASSERT_EQ(table.regions.size(), 2u);
  EXPECT_EQ(table.regions[0].name, "all.1") << "attribute 3";
  EXPECT_EQ(table.regions[1].name, "core # 1") << "attribute 7";
  ASSERT_EQ(table.patches.size(), 2u) << "the triangle is no quad";
  EXPECT_EQ(table.patches[0].name, "walls.1");
  EXPECT_EQ(table.patches[0].members.size(), 1u);
  EXPECT_EQ(table.patches[1].name, "walls.2");
  EXPECT_EQ(table.patches[1].members.size(), 2u);
  ASSERT_EQ(table.patch_groups.size(), 1u);
  EXPECT_EQ(table.patch_groups[0].name, "walls");
}

TEST(Mfem, AttributesWithoutANameAreKnownByTheirNumber) {
  const TempFolder folder;
  std::string text = kTwoCubes;
  text.replace(text.find("v1.3"), 4, "v1.0");
  text.erase(text.find("attribute_sets"), text.find("boundary\n") - text.find("attribute_sets"));
  text.erase(text.find("bdr_attribute_sets"),
             text.find("vertices") - text.find("bdr_attribute_sets"));
  text.erase(text.find("mfem_mesh_end"));
  const SetTable table = make_set_table(read_hex_mesh(folder.write("a.mesh", text)));
  ASSERT_EQ(table.regions.size(), 2u);
  EXPECT_EQ(table.regions[0].name, "attribute_3");
  EXPECT_EQ(table.regions[1].name, "attribute_7");
  ASSERT_EQ(table.patches.size(), 2u);
  EXPECT_EQ(table.patches[1].name, "bdr_attribute_5");
}

TEST(Mfem, WhatCannotBeReadIsNamedWithItsPlace) {
  EXPECT_NE(refusal("MFEM mesh v1.3", "MFEM NC mesh v1.0").find("a.mesh:1: 'MFEM NC mesh v1.0'"),
            std::string::npos)
      << refusal("MFEM mesh v1.3", "MFEM NC mesh v1.0");
  EXPECT_NE(
      refusal("3\n\nelements", "2\n\nelements").find("a.mesh:5: the mesh is not one in three"),
      std::string::npos);
  EXPECT_NE(refusal("3 5 1 2", "3 6 1 2").find("a.mesh:10: the mesh has prisms"),
            std::string::npos);
  EXPECT_NE(refusal("3 5 1 2", "3 5 1 12").find("vertex 12 of 12"), std::string::npos);
  EXPECT_NE(refusal("elements\n2", "elements\n99999").find("a.mesh:8: 99999 is more"),
            std::string::npos);
  EXPECT_NE(refusal("elements\n2", "elements\n1").find("expected the name of a section"),
            std::string::npos);
  EXPECT_NE(refusal("\"walls\"", "walls").find("in quotes"), std::string::npos);
  EXPECT_NE(refusal("mfem_mesh_end", "vertices\n1\n3\n0 0 0\nmfem_mesh_end")
                .find("the vertices come twice"),
            std::string::npos);
  for (const char* section : {"elements", "boundary"})
    EXPECT_NE(refusal("mfem_mesh_end", std::string(section) + "\n1\n3 0 0 1 2\nmfem_mesh_end")
                  .find("elements stand behind the vertices"),
              std::string::npos)
        << section;
  EXPECT_NE(
      refusal("12\n3\n0 0 0", "12\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P4\n")
          .find("set the mesh's curvature to order 1 or 2"),
      std::string::npos);
  EXPECT_NE(
      refusal("2 1 1\n\nmfem_mesh_end\nwhat follows is not the mesh's\n", "").find("truncated"),
      std::string::npos);
}

}  // namespace
}  // namespace hexwright
