// Names of parts of a surface, from files and back.
#include <algorithm>

#include <gtest/gtest.h>

#include "hexwright/io/surface_io.h"

#include "helpers.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

TriMesh read_text(const std::string& name, const std::string& content) {
  const TempFolder folder;
  return read_surface(folder.write(name, content)).mesh;
}

/// The name of every triangle's group, in order.
std::vector<std::string> names_of(const TriMesh& mesh) {
  EXPECT_FALSE(mesh.find_problem());
  std::vector<std::string> names;
  for (std::int32_t group : mesh.group)
    names.push_back(group < 0 ? "-" : mesh.group_names[static_cast<std::size_t>(group)]);
  return names;
}

using Names = std::vector<std::string>;

std::string solid(const std::string& line) {
  return line + "\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" +
         "endloop\nendfacet\nendsolid\n";
}

TEST(SurfaceNames, SolidsOfStlAreGroups) {
  const TriMesh mesh = read_text("a.stl", solid("solid inlet") + solid("solid  outer wall \r") +
                                              solid("SOLID inlet") + solid("solid"));
  EXPECT_EQ(names_of(mesh), (Names{"inlet", "outer wall", "inlet", ""}));
  EXPECT_EQ(mesh.group_names, (Names{"inlet", "outer wall", ""}));
}

TEST(SurfaceNames, SolidsWithoutNamesAreNoGroups) {
  EXPECT_TRUE(read_text("a.stl", solid("solid") + solid("solid ")).group.empty());
}

TEST(SurfaceNames, BytesThatAreNoTextAreReplaced) {
  EXPECT_EQ(read_text("a.stl", solid("solid a\x01"
                                     "b\xff"
                                     "c\xc3\xa9\xe2\x82"))
                .group_names,
            (Names{"a_b_c\xc3\xa9__"}));
  EXPECT_EQ(
      read_text("a.stl", solid("solid \xed\xa0\x80 \xe0\x80\x80 \xf4\x90\x80\x80")).group_names,
      (Names{"___ ___ ____"}))
      << "a surrogate, a form that is too long, and beyond the last character";
  EXPECT_EQ(read_text("a.stl", solid("solid " + std::string(500, 'x'))).group_names[0].size(),
            200u);
  std::string long_name = "x";
  for (int i = 0; i < 100; ++i) long_name += "\xe2\x82\xac";
  EXPECT_EQ(read_text("a.stl", solid("solid " + long_name)).group_names[0].size(), 199u)
      << "no character is cut in two";
}

const std::string kVerts = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kFace = "f 1 2 3\n";

TEST(SurfaceNames, GroupsOfObjComeBeforeMaterialsAndObjects) {
  EXPECT_EQ(names_of(read_text("a.obj", kVerts + "o body\nusemtl red\ng in\n" + kFace +
                                            "usemtl blue\ng out 2\n" + kFace)),
            (Names{"in", "out 2"}));
  EXPECT_EQ(names_of(read_text(
                "a.obj", kVerts + "o body\ng all\nusemtl red\n" + kFace + "usemtl blue\n" + kFace)),
            (Names{"red", "blue"}));
  EXPECT_EQ(names_of(read_text("a.obj", kVerts + "o a\n" + kFace + "o b\n" + kFace)),
            (Names{"a", "b"}));
  EXPECT_EQ(names_of(read_text("a.obj", kVerts + "o body\nusemtl red\n" + kFace)), (Names{"red"}));
  EXPECT_EQ(names_of(read_text("a.obj", kVerts + kFace + "g in\n" + kFace)), (Names{"", "in"}));
  EXPECT_TRUE(read_text("a.obj", kVerts + kFace + "g unused\n").group.empty());
  EXPECT_TRUE(read_text("a.obj", kVerts + "g\n" + kFace).group.empty());
}

TEST(SurfaceNames, TrianglesOfAPolygonShareItsGroup) {
  EXPECT_EQ(names_of(read_text("a.obj", kVerts + "g q\nf 1 2 3 4\ng t\n" + kFace)),
            (Names{"q", "q", "t"}));
}

std::string ply(const std::string& properties, const std::string& faces,
                const char* comments = "") {
  return std::string("ply\nformat ascii 1.0\n") + comments +
         "element vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 2\n" +
         properties + "end_header\n0 0 0\n1 0 0\n0 1 0\n" + faces;
}
constexpr const char* kList = "property list uchar int vertex_indices\n";

TEST(SurfaceNames, FacePropertiesOfPlyAreGroups) {
  for (const char* name : {"patch", "label", "group", "material"}) {
    const std::string property = std::string("property int ") + name + "\n";
    EXPECT_EQ(names_of(read_text("a.ply", ply(kList + property, "3 0 1 2 0\n3 0 1 2 7\n"))),
              (Names{name + std::string("_0"), name + std::string("_7")}));
    EXPECT_EQ(names_of(read_text("a.ply", ply(property + kList, "4 3 0 1 2\n-1 3 0 1 2\n"))),
              (Names{name + std::string("_4"), ""}));
  }
  EXPECT_EQ(names_of(read_text(
                "a.ply", ply("property int material\nproperty int patch\n" + std::string(kList),
                             "1 2 3 0 1 2\n1 3 3 0 1 2\n"))),
            (Names{"patch_2", "patch_3"}));
  const std::string real = std::string(kList) + "property float label\n";
  EXPECT_TRUE(read_text("a.ply", ply(real, "3 0 1 2 1\n3 0 1 2 2\n")).group.empty());
}

TEST(SurfaceNames, CommentsOfPlyNameTheGroups) {
  const char* comments = "comment group 1 in let\ncomment made by hand\ncomment group x y\n";
  EXPECT_EQ(names_of(read_text("a.ply", ply(std::string(kList) + "property uchar group\n",
                                            "3 0 1 2 1\n3 0 1 2 2\n", comments))),
            (Names{"in let", "group_2"}));
}

TEST(SurfaceNames, ComeBackFromEveryFormatThatHasThem) {
  TriMesh cube = test::unit_cube_surface();
  cube.group_names = {"top", "a side", ""};
  for (TriId t : cube.tris.ids()) cube.group.push_back(t.value() / 4);
  const TempFolder folder;
  for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
    write_surface(folder / name, cube);
    const TriMesh back = read_surface(folder / name).mesh;
    ASSERT_EQ(back.num_tris(), 12u) << name;
    auto expected = names_of(cube), found = names_of(back);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());  // solids are sorted by name
    EXPECT_EQ(found, expected) << name;
  }
  EXPECT_EQ(names_of(read_surface(folder / "a.ply").mesh), names_of(cube));
}

}  // namespace
}  // namespace hexwright
