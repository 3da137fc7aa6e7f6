// Sets in Gmsh and Abaqus files say what the labels say.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::labelled_box;
using test::TempFolder;

// Faces of a C3D8 by Abaqus' manual, as node positions counted from 1.
constexpr int kAbaqusFaces[6][4] = {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2},
                                    {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};

using Nodes = std::set<int>;

/// The keyword lines of an .inp file with the numbers below them.
std::map<std::string, std::vector<std::vector<std::string>>> read_blocks(const std::string& text) {
  std::map<std::string, std::vector<std::vector<std::string>>> blocks;
  std::istringstream in(text);
  std::string line, keyword;
  while (std::getline(in, line)) {
    if (line[0] == '*') {
      keyword = line;
      continue;
    }
    std::vector<std::string> words;
    std::istringstream fields(line);
    for (std::string word; std::getline(fields >> std::ws, word, ',');) words.push_back(word);
    blocks[keyword].push_back(words);
  }
  return blocks;
}

TEST(Abaqus, SurfacesNameTheFacesOfTheLabelledQuads) {
  const TempFolder folder;
  const HexMesh mesh = labelled_box();
  write_hex_mesh(folder / "a.inp", mesh);
  const auto blocks = read_blocks(test::slurp(folder / "a.inp"));
  ASSERT_EQ(blocks.at("*NODE").size(), mesh.num_verts());
  std::size_t num_faces = 0;
  for (std::int32_t patch = -1; patch < 6; ++patch) {
    std::multiset<Nodes> expected, found;
    for (const LabeledQuad& quad : mesh.labels.quads) {
      if (quad.patch.value() != patch) continue;
      Nodes nodes;
      for (VertId v : quad.verts) nodes.insert(v.value() + 1);
      expected.insert(nodes);
    }
    const std::string name = patch < 0 ? "PATCH_NONE" : "PATCH_" + std::to_string(patch);
    for (const auto& row : blocks.at("*SURFACE, NAME=" + name + ", TYPE=ELEMENT")) {
      const auto& hex = mesh.hexes[HexId(std::stoi(row[0]) - 1)];
      Nodes nodes;
      for (int position : kAbaqusFaces[row[1][1] - '1'])
        nodes.insert(hex[static_cast<std::size_t>(position - 1)].value() + 1);
      found.insert(nodes);
      ++num_faces;
    }
    EXPECT_EQ(found, expected) << name;
  }
  EXPECT_EQ(num_faces, mesh.labels.quads.size());
}

TEST(Abaqus, NumbersFitIntoTwentyCharacters) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  for (Vec3& p : mesh.positions) p = p * (-1.0 / 3) + Vec3{1e-200, -1e250, 1.0 / 7};
  write_hex_mesh(folder / "a.inp", mesh);
  const auto blocks = read_blocks(test::slurp(folder / "a.inp"));
  for (const auto& row : blocks.at("*NODE"))
    for (const std::string& word : row) EXPECT_LE(word.size(), 20u) << word;
}

TEST(Abaqus, QuadsThatAreNoFaceAreRefused) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.labels.quads.push_back({{VertId(0), VertId(1), VertId(6), VertId(7)}, PatchId(0)});
  EXPECT_THROW(write_hex_mesh(folder / "a.inp", mesh), Error);
  EXPECT_EQ(folder.num_files(), 0u);
}

TEST(Gmsh, CountsAndNamesMatchTheLabels) {
  const TempFolder folder;
  HexMesh mesh = labelled_box();
  mesh.region[HexId(0)] = -2;
  write_hex_mesh(folder / "a.msh", mesh);
  const std::string text = test::slurp(folder / "a.msh");
  for (const char* name : {"\"REGION_0\"", "\"REGION_MINUS_2\"", "\"PATCH_NONE\"", "\"PATCH_4\"",
                           "\"CURVE_2\"", "\"CURVE_NONE\"", "\"CORNERS\""})
    EXPECT_NE(text.find(name), std::string::npos) << name;
  std::istringstream in(text.substr(text.find("$Elements")));
  std::string keyword;
  std::size_t num_blocks = 0, num_elements = 0, first = 0, last = 0, seen = 0;
  in >> keyword >> num_blocks >> num_elements >> first >> last;
  const std::size_t expected = mesh.num_hexes() + mesh.labels.quads.size() +
                               mesh.labels.edges.size() + mesh.labels.corners.size();
  EXPECT_EQ(num_elements, expected);
  const std::map<int, int> num_nodes_of_type = {{15, 1}, {1, 2}, {3, 4}, {5, 8}};
  for (std::size_t b = 0; b < num_blocks; ++b) {
    int dimension = 0, entity = 0, type = 0, count = 0;
    in >> dimension >> entity >> type >> count;
    EXPECT_GT(entity, 0) << "tags are positive";
    for (int i = 0; i < count * (1 + num_nodes_of_type.at(type)); ++i) in >> keyword;
    seen += static_cast<std::size_t>(count);
  }
  in >> keyword;
  EXPECT_EQ(keyword, "$EndElements");
  EXPECT_EQ(seen, expected);
}

}  // namespace
}  // namespace hexwright
