// Sheets that end at sides of the domain, which no label names.
#include <gtest/gtest.h>

#include "hexwright/layers/layers.h"

#include "layer_helpers.h"

namespace hexwright {
namespace {

using namespace test;

constexpr int kCells = 5;
constexpr double kTilt = 0.3;

Vec3 tilted(const Vec3& p) { return {p.x, p.y, p.z + kTilt * p.x}; }

/// Between two patches, "zmin" and "zmax", which go on beyond the domain's sides.
HexMesh domain() {
  HexMesh mesh = labelled_box(kCells, kCells, kCells);
  std::erase_if(mesh.labels.quads, [](const LabeledQuad& quad) { return quad.patch < PatchId(4); });
  mesh.labels.edges.clear();
  mesh.labels.corners.clear();
  return mesh;
}

HexMesh tilted_domain() {
  HexMesh mesh = domain();
  for (Vec3& p : mesh.positions) p = tilted(p);
  return mesh;
}

Target tilted_target() {
  TriMesh surface = box_surface({-2, -2, 0}, {kCells + 2, kCells + 2, kCells});
  for (Vec3& p : surface.positions) p = tilted(p);
  return wrap_target(surface);
}

bool is_on_side(const Vec3& p, int axis) { return p[axis] == 0 || p[axis] == kCells; }

constexpr const char* kLayers = "zmin=first:0.1,growth:1,count:4";

void expect_left_out(const HexMesh& mesh, const Target& target,
                     const std::vector<std::string>& words) {
  const LayersResult result = add_layers(mesh, target, layers_of({kLayers}), {});
  EXPECT_EQ(result.mesh.num_hexes(), mesh.num_hexes());
  ASSERT_EQ(result.report.patches.size(), 1u);
  const std::string& note = result.report.patches[0].note;
  for (const std::string& word : words) EXPECT_NE(note.find(word), std::string::npos) << note;
}

TEST(DomainSides, KeepTheirVerticesWhereSheetsEndInThem) {
  const HexMesh before = tilted_domain();
  const LayersResult result = add_layers(before, tilted_target(), layers_of({kLayers}), {});
  EXPECT_DOUBLE_EQ(result.report.coverage(), 1);
  std::size_t num_on_edges = 0;
  for (const HexFace& face : compute_hex_neighbors(result.mesh).boundary) {
    const auto quad = face_verts(result.mesh, face);
    for (int axis = 0; axis < 2; ++axis)
      for (const double at : {0.0, double(kCells)}) {
        const auto& p = result.mesh.positions;
        const auto is_near = [&](VertId v) { return std::abs(p[v][axis] - at) < 0.3; };
        if (!std::all_of(quad.begin(), quad.end(), is_near)) continue;
        for (VertId v : quad) {
          EXPECT_NEAR(p[v][axis], at, 1e-9);
          num_on_edges += std::abs(p[v][1 - axis]) < 0.3;
        }
      }
  }
  EXPECT_GT(num_on_edges, 20u);
  // The patch without layers keeps the vertices that it shares with the sides.
  for (const LabeledQuad& quad : before.labels.quads)
    for (VertId v : quad.verts)
      if (is_on_side(before.positions[v], 0) || is_on_side(before.positions[v], 1)) {
        EXPECT_EQ(result.mesh.positions[v], before.positions[v]);
      }
}

TEST(DomainSides, ThatLeaveNoRoomForAnEndAreNamed) {
  HexMesh mesh = domain();
  for (Vec3& p : mesh.positions) p.x -= 6 * p.z;  // one side leans far outwards
  const Target target = wrap_target(box_surface({-40, -2, 0}, {kCells + 2, kCells + 2, kCells}));
  expect_left_out(mesh, target, {"a side of the domain", "move that side"});
}

TEST(DomainSides, WhereTwoRegionsEndAreNamed) {
  HexMesh mesh = tilted_domain();
  mesh.region_names = {"left", "right"};
  for (HexId h : mesh.hexes.ids()) mesh.region.push_back(h.index() % kCells < 2 ? 0 : 1);
  expect_left_out(mesh, tilted_target(), {"two regions", "move that side"});
}

}  // namespace
}  // namespace hexwright
