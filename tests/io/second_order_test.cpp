// Meshes of second order come back from every format that has them.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/hex_quality.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::curved_box;
using test::TempFolder;

using Key = std::array<long, 3>;
Key key_of(const Vec3& p) {
  return {std::lround(p.x * 1e7), std::lround(p.y * 1e7), std::lround(p.z * 1e7)};
}

/// The 27 nodes of every hex by its first corner: formats may reorder hexes.
std::map<Key, QuadraticHex> nodes_by_hex(const HexMesh& mesh) {
  std::map<Key, QuadraticHex> nodes;
  for (HexId h : mesh.hexes.ids())
    nodes[key_of(mesh.positions[mesh.hexes[h][0]])] = quadratic_hex(mesh, h);
  return nodes;
}

std::string refusal(const HexMesh& mesh, const std::string& name, int nodes_per_hex = 0) {
  const TempFolder folder;
  WriteHexOptions options;
  options.nodes_per_hex = nodes_per_hex;
  try {
    write_hex_mesh(folder / name, mesh, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    EXPECT_EQ(folder.num_files(), 0u);
    return error.what();
  }
  return "";
}

TEST(SecondOrder, ComesBackFromEveryFormatThatIsRead) {
  const TempFolder folder;
  const HexMesh mesh = curved_box();
  const auto expected = nodes_by_hex(mesh);
  for (const auto& [name, nodes_per_hex] :
       std::initializer_list<std::pair<const char*, int>>{{"a.vtu", 20},
                                                          {"a.vtu", 27},
                                                          {"a.vtk", 20},
                                                          {"a.vtk", 27},
                                                          {"a.msh", 20},
                                                          {"a.msh", 27},
                                                          {"a.msh2", 20},
                                                          {"a.msh2", 27},
                                                          {"a.inp", 20},
                                                          {"a.exo", 20},
                                                          {"a.mfem", 27}}) {
    SCOPED_TRACE(std::string(name) + " " + std::to_string(nodes_per_hex));
    WriteHexOptions options;
    options.nodes_per_hex = nodes_per_hex;
    write_hex_mesh(folder / name, mesh, options);
    const HexMesh back = read_hex_mesh(folder / name);
    ASSERT_TRUE(back.mid_nodes);
    EXPECT_EQ(back.num_verts(), mesh.num_verts());
    EXPECT_EQ(back.mid_nodes->edges.size(), mesh.mid_nodes->edges.size());
    EXPECT_EQ(back.mid_nodes->inner.empty(), nodes_per_hex == 20);
    EXPECT_EQ(back.labels.quads.size(), mesh.labels.quads.size());
    const auto found = nodes_by_hex(back);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [place, nodes] : expected)
      for (std::size_t n = 0; n < 27; ++n)
        EXPECT_LT(distance(found.at(place)[n], nodes[n]), 1e-9) << n;
  }
}

TEST(SecondOrder, GivesItsSetsTheirMidNodes) {
  const TempFolder folder;
  const HexMesh mesh = curved_box();
  WriteHexOptions options;
  write_hex_mesh(folder / "a.inp", mesh, options);
  const std::string text = test::slurp(folder / "a.inp");
  const auto at = text.find("*NSET, NSET=inlet_NODES\n");
  ASSERT_NE(at, std::string::npos);
  const std::string set = text.substr(at, text.find("\n*", at) - at);
  // 3 x 2 quads: 12 vertices and 17 edges.
  EXPECT_EQ(std::count(set.begin(), set.end(), ',') - 1 + std::count(set.begin(), set.end(), '\n'),
            12 + 17)
      << set;
}

TEST(SecondOrder, IsLeftOutWhenThatIsAskedFor) {
  const TempFolder folder;
  HexMesh mesh = curved_box();
  WriteHexOptions options;
  options.nodes_per_hex = 8;
  write_hex_mesh(folder / "a.msh", mesh, options);
  mesh.mid_nodes.reset();
  write_hex_mesh(folder / "b.msh", mesh, {});
  EXPECT_EQ(test::slurp(folder / "a.msh"), test::slurp(folder / "b.msh"));
}

TEST(SecondOrder, IsRefusedWithTheFormatsThatHaveIt) {
  const HexMesh mesh = curved_box();
  for (const char* name : {"a.mesh", "a.su2", "a.k", "polyMesh"}) {
    const std::string message = refusal(mesh, name);
    EXPECT_NE(message.find("no hexes of second order"), std::string::npos) << name << message;
    EXPECT_NE(message.find("Abaqus .inp"), std::string::npos) << message;
  }
  const std::string message = refusal(mesh, "a.inp", 27);
  EXPECT_NE(message.find("no hexes of 27 nodes"), std::string::npos) << message;
  EXPECT_NE(message.find("MFEM .mfem"), std::string::npos) << message;
  EXPECT_EQ(message.find("Nastran"), std::string::npos) << message;
}

/// Two hexes with nodes of their own on the edges that they share.
TEST(SecondOrder, OfHexesThatDoNotAgreeIsRefused) {
  const TempFolder folder;
  HexMesh mesh = test::box_hex_mesh(2, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  write_hex_mesh(folder / "a.inp", mesh, {});
  std::string text = test::slurp(folder / "a.inp");
  // The second hex gets another node on its edge 0-3, which is the first one's 1-2.
  const auto second = text.find("\n2, ", text.find("*ELEMENT"));
  ASSERT_NE(second, std::string::npos);
  const std::string shared =
      std::to_string(mesh.num_verts() + mesh.mid_nodes->hex_to_edge[HexId(1)][3].index() + 1);
  const std::string other =
      std::to_string(mesh.num_verts() + mesh.mid_nodes->hex_to_edge[HexId(1)][1].index() + 1);
  const auto at = text.find(" " + shared + ",", second);
  ASSERT_NE(at, std::string::npos);
  text.replace(at + 1, shared.size(), other);
  try {
    read_hex_mesh(folder.write("b.inp", text));
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_NE(std::string(error.what()).find("shares an edge with hex 0"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace hexwright
