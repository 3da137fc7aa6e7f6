// Gmsh and Abaqus files read back by readers of the formats' manuals, written here: every node,
// hex and label comes back, and the local numberings give unit volumes and outward normals.
#include <algorithm>
#include <bit>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/io/mesh_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

/// What a Gmsh 4.1 file says, keyed as the file keys it.
struct GmshFile {
  struct Element {
    int dimension = 0, type = 0;
    std::string group;  ///< name of the physical group of its entity
    std::vector<int> nodes;
  };
  std::map<int, Vec3> nodes;
  std::vector<Element> elements;
  std::map<std::pair<int, int>, std::string> names;  ///< (dimension, tag)
  std::map<std::pair<int, int>, Box3> boxes;         ///< of entities
};

/// Follows the manual's "MSH file format version 4.1", text form, section by section.
class GmshReader {
 public:
  explicit GmshReader(const std::string& text) : in_(text) {}

  GmshFile run() {
    for (std::string section; in_ >> section;) {
      if (section == "$MeshFormat") expect_words({"4.1", "0", "8"});
      if (section == "$PhysicalNames") read_names();
      if (section == "$Entities") read_entities();
      if (section == "$Nodes") read_nodes();
      if (section == "$Elements") read_elements();
      std::string end;
      in_ >> end;
      EXPECT_EQ(end, "$End" + section.substr(1));
    }
    return std::move(file_);
  }

 private:
  int integer() {
    int value = 0;
    EXPECT_TRUE(static_cast<bool>(in_ >> value));
    return value;
  }
  Vec3 point() {
    Vec3 p;
    EXPECT_TRUE(static_cast<bool>(in_ >> p.x >> p.y >> p.z));
    return p;
  }
  void expect_words(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      std::string found;
      in_ >> found;
      EXPECT_EQ(found, word);
    }
  }

  void read_names() {
    for (int left = integer(); left > 0; --left) {
      const int dimension = integer(), tag = integer();
      std::string name;
      in_ >> name;
      EXPECT_TRUE(
          file_.names.try_emplace({dimension, tag}, name.substr(1, name.size() - 2)).second);
    }
  }

  void read_entities() {
    std::array<int, 4> count;
    for (int& n : count) n = integer();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (int left = count[std::size_t(dimension)]; left > 0; --left) {
        const int tag = integer();
        Box3 box;
        box.extend(point());
        if (dimension > 0) box.extend(point());
        EXPECT_EQ(integer(), 1);  // one physical group
        const int group = integer();
        if (dimension > 0) {
          EXPECT_EQ(integer(), 0);  // no bounding entities
        }
        EXPECT_TRUE(file_.names.contains({dimension, group}));
        EXPECT_TRUE(group_.try_emplace({dimension, tag}, group).second) << "an entity twice";
        file_.boxes[{dimension, tag}] = box;
      }
  }

  void read_nodes() {
    const int num_blocks = integer(), num_nodes = integer();
    const int least = integer(), most = integer();
    for (int b = 0; b < num_blocks; ++b) {
      const int dimension = integer(), entity = integer();
      EXPECT_TRUE(group_.contains({dimension, entity}));
      EXPECT_EQ(integer(), 0);  // not parametric
      std::vector<int> tags(static_cast<std::size_t>(integer()));
      for (int& tag : tags) {
        tag = integer();
        EXPECT_TRUE(tag >= least && tag <= most);
      }
      for (int tag : tags) EXPECT_TRUE(file_.nodes.emplace(tag, point()).second);
    }
    EXPECT_EQ(file_.nodes.size(), std::size_t(num_nodes));
  }

  void read_elements() {
    const std::map<int, int> num_nodes = {{15, 1}, {1, 2}, {3, 4}, {5, 8}};
    const int num_blocks = integer(), num_elements = integer();
    const int least = integer(), most = integer();
    std::set<int> tags;
    for (int b = 0; b < num_blocks; ++b) {
      const int dimension = integer(), entity = integer(), type = integer();
      for (int left = integer(); left > 0; --left) {
        const int tag = integer();
        EXPECT_TRUE(tag >= least && tag <= most && tags.insert(tag).second);
        GmshFile::Element element{dimension, type, {}, {}};
        element.group = file_.names.at({dimension, group_.at({dimension, entity})});
        for (int k = 0; k < num_nodes.at(type); ++k) {
          element.nodes.push_back(integer());
          const Vec3 p = file_.nodes.at(element.nodes.back());
          EXPECT_TRUE(file_.boxes.at({dimension, entity}).contains(p));
        }
        file_.elements.push_back(element);
      }
    }
    EXPECT_EQ(tags.size(), std::size_t(num_elements));
  }

  std::istringstream in_;
  GmshFile file_;
  std::map<std::pair<int, int>, int> group_;
};

/// Volume of a hexahedron in Gmsh's and Abaqus' order (bottom counter-clockwise seen from above,
/// then the top above it): its centre over the six faces, by the divergence theorem.
double volume_by_faces(const std::vector<Vec3>& p, const int faces[6][4]) {
  double volume = 0;
  for (int f = 0; f < 6; ++f) {
    const Vec3 &a = p[std::size_t(faces[f][0])], &b = p[std::size_t(faces[f][1])],
               &c = p[std::size_t(faces[f][2])], &d = p[std::size_t(faces[f][3])];
    volume += dot(a + b + c + d, cross(c - a, d - b)) / 24;
  }
  return volume;
}

/// Faces of the element, outward, as Gmsh's manual draws its hexahedron.
constexpr int kGmshFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                  {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

using NodeSet = std::set<int>;

NodeSet node_set(std::span<const VertId> verts) {
  NodeSet nodes;
  for (VertId v : verts) nodes.insert(v.value() + 1);
  return nodes;
}

std::string label_name(const char* prefix, std::int32_t label) {
  return std::string(prefix) + (label < 0 ? "_NONE" : "_" + std::to_string(label));
}

TEST(Gmsh, EveryNodeHexAndLabelComesBack) {
  const TempFolder folder;
  const HexMesh mesh = test::labelled_box();
  write_hex_mesh(folder / "a.msh", mesh);
  const GmshFile file = GmshReader(test::slurp(folder / "a.msh")).run();
  ASSERT_EQ(file.nodes.size(), mesh.num_verts());
  for (VertId v : mesh.positions.ids())
    EXPECT_EQ(file.nodes.at(v.value() + 1), mesh.positions[v]);  // bit by bit

  std::multiset<std::pair<std::string, NodeSet>> expected, found;
  for (HexId h : mesh.hexes.ids())
    expected.insert({label_name("REGION", mesh.region[h]), node_set(mesh.hexes[h])});
  for (const LabeledQuad& q : mesh.labels.quads)
    expected.insert({label_name("PATCH", q.patch.value()), node_set(q.verts)});
  for (const LabeledEdge& e : mesh.labels.edges)
    expected.insert({label_name("CURVE", e.curve.value()), node_set(e.verts)});
  for (VertId v : mesh.labels.corners) expected.insert({"CORNERS", {v.value() + 1}});
  for (const auto& e : file.elements)
    found.insert({e.group, NodeSet(e.nodes.begin(), e.nodes.end())});
  EXPECT_EQ(found, expected);
}

TEST(Gmsh, HexesHaveUnitVolumeAndQuadsLookOutwards) {
  const TempFolder folder;
  const HexMesh mesh = test::labelled_box();
  write_hex_mesh(folder / "a.msh", mesh);
  const GmshFile file = GmshReader(test::slurp(folder / "a.msh")).run();
  const Vec3 middle = bounding_box(mesh).center();
  Vec3 sum;
  for (const auto& element : file.elements) {
    std::vector<Vec3> p;
    for (int node : element.nodes) p.push_back(file.nodes.at(node) - middle);
    if (element.dimension == 3) {
      EXPECT_NEAR(volume_by_faces(p, kGmshFaces), 1, 1e-6);
    } else if (element.dimension == 2) {
      const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]) * 0.5;
      sum += normal;
      EXPECT_NEAR(norm(normal), 1, 1e-6);
      EXPECT_GT(dot(normal, p[0] + p[1] + p[2] + p[3]), 0) << "a quad that looks inwards";
    }
  }
  EXPECT_NEAR(norm(sum), 0, 1e-6);
}

TEST(Gmsh, AMeshWithoutLabelsIsOneRegion) {
  const TempFolder folder;
  const HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  write_hex_mesh(folder / "a.msh", mesh);
  const GmshFile file = GmshReader(test::slurp(folder / "a.msh")).run();
  EXPECT_EQ(file.elements.size(), 2u);
  EXPECT_EQ(file.names.size(), 1u);
}

/// The lines below a keyword line of an .inp file, as numbers.
std::vector<std::vector<double>> numbers_below(const std::string& text,
                                               const std::string& keyword) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(text);
  bool is_below = false;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '*') {
      is_below = line == keyword;
      continue;
    }
    if (!is_below) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    rows.emplace_back();
    for (double value = 0; fields >> value;) rows.back().push_back(value);
  }
  return rows;
}

// CalculiX' manual: C3D8 has the nodes 1-4 counter-clockwise seen from nodes 5-8.
TEST(Abaqus, ElementsAndSetsComeBack) {
  const TempFolder folder;
  HexMesh mesh = test::labelled_box();
  for (Vec3& p : mesh.positions) p = p + Vec3{0, 0, -1e5 + 1.0 / 7};
  write_hex_mesh(folder / "a.inp", mesh);
  const std::string text = test::slurp(folder / "a.inp");
  std::map<int, Vec3> nodes;
  for (const auto& row : numbers_below(text, "*NODE"))
    nodes[int(row.at(0))] = {row.at(1), row.at(2), row.at(3)};
  ASSERT_EQ(nodes.size(), mesh.num_verts());
  for (VertId v : mesh.positions.ids())
    EXPECT_LE(distance(nodes.at(v.value() + 1), mesh.positions[v]),
              1e-12 * norm(mesh.positions[v]));
  std::set<int> seen;
  for (int region = 0; region < 3; ++region)
    for (const auto& row :
         numbers_below(text, "*ELEMENT, TYPE=C3D8, ELSET=REGION_" + std::to_string(region))) {
      ASSERT_EQ(row.size(), 9u);
      const HexId h(int(row[0]) - 1);
      EXPECT_EQ(mesh.region[h], region);
      EXPECT_TRUE(seen.insert(h.value()).second);
      std::vector<Vec3> p;
      for (std::size_t k = 1; k < 9; ++k) p.push_back(nodes.at(int(row[k])));
      EXPECT_NEAR(volume_by_faces(p, kGmshFaces), 1, 1e-9);
    }
  EXPECT_EQ(seen.size(), mesh.num_hexes());

  const auto expect_set = [&](const std::string& name, const NodeSet& expected) {
    NodeSet found;
    for (const auto& row : numbers_below(text, "*NSET, NSET=" + name))
      for (double node : row) EXPECT_TRUE(found.insert(int(node)).second) << name;
    EXPECT_EQ(found, expected) << name;
  };
  for (std::int32_t patch = -1; patch < 6; ++patch) {
    NodeSet expected;
    for (const LabeledQuad& q : mesh.labels.quads)
      if (q.patch.value() == patch) expected.merge(node_set(q.verts));
    expect_set(label_name("PATCH", patch) + "_NODES", expected);
  }
  for (std::int32_t curve = -1; curve < 3; ++curve) {
    NodeSet expected;
    for (const LabeledEdge& e : mesh.labels.edges)
      if (e.curve.value() == curve) expected.merge(node_set(e.verts));
    expect_set(label_name("CURVE", curve), expected);
  }
  expect_set("CORNERS", node_set(mesh.labels.corners));
}

/// Permutes a cube's vertices as its rotations do: 24 ways to write the same hex.
std::vector<std::array<std::size_t, 8>> hex_rotations() {
  const HexMesh cube = test::box_hex_mesh(1, 1, 1);
  const auto corners = cube.corners(HexId(0));
  std::vector<std::array<std::size_t, 8>> rotations;
  for (int axes = 0; axes < 6; ++axes)
    for (int signs = 0; signs < 8; ++signs) {
      constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                     {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
      const bool is_odd = (axes >= 3) != (std::popcount(unsigned(signs)) % 2 == 1);
      if (is_odd) continue;  // a mirror
      std::array<std::size_t, 8> rotation{};
      for (std::size_t k = 0; k < 8; ++k) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
          const double x = corners[k][kOrders[axes][axis]];
          p[axis] = signs >> axis & 1 ? 1 - x : x;
        }
        rotation[k] = std::size_t(std::find(corners.begin(), corners.end(), p) - corners.begin());
      }
      rotations.push_back(rotation);
    }
  return rotations;
}

// However a hex is listed, its volume stays one in every format, and the labelled faces are found.
TEST(Numberings, HoldForAllRotationsOfAHex) {
  const TempFolder folder;
  const auto rotations = hex_rotations();
  ASSERT_EQ(rotations.size(), 24u);
  const HexMesh cube = test::box_hex_mesh(1, 1, 1);
  for (const auto& rotation : rotations) {
    HexMesh mesh = cube;
    for (std::size_t k = 0; k < 8; ++k) mesh.hexes[HexId(0)][k] = cube.hexes[HexId(0)][rotation[k]];
    for (HexFace face : compute_hex_neighbors(mesh).boundary)
      mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(face.lf)});
    for (const char* name : {"a.vtu", "a.vtk", "a.mesh"}) {
      write_hex_mesh(folder / name, mesh);
      const HexMesh back = read_hex_mesh(folder / name);
      EXPECT_EQ(back.hexes, mesh.hexes) << name;
      EXPECT_EQ(back.labels, mesh.labels) << name;
    }
    write_hex_mesh(folder / "a.msh", mesh);
    const GmshFile file = GmshReader(test::slurp(folder / "a.msh")).run();
    for (const auto& element : file.elements) {
      std::vector<Vec3> p;
      for (int node : element.nodes) p.push_back(file.nodes.at(node));
      if (element.dimension == 3) {
        EXPECT_NEAR(volume_by_faces(p, kGmshFaces), 1, 1e-12);
      }
    }
    write_hex_mesh(folder / "a.inp", mesh);
    const std::string text = test::slurp(folder / "a.inp");
    constexpr int kAbaqusFaces[6][4] = {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2},
                                        {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
    for (int patch = 0; patch < 6; ++patch) {
      const std::string keyword =
          "*SURFACE, NAME=PATCH_" + std::to_string(patch) + ", TYPE=ELEMENT\n1, S";
      const auto at = text.find(keyword);
      ASSERT_NE(at, std::string::npos);
      std::set<VertId> found, expected;
      for (int k : kAbaqusFaces[text[at + keyword.size()] - '1'])
        found.insert(mesh.hexes[HexId(0)][std::size_t(k - 1)]);
      for (const LabeledQuad& q : mesh.labels.quads)
        if (q.patch.value() == patch) expected.insert(q.verts.begin(), q.verts.end());
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace hexwright
