#include "hexwright/layers/layers.h"

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/hex_topology.h"

#include "layer_helpers.h"

namespace hexwright {
namespace {

using namespace test;

constexpr const char* kEight = "=first:0.05,growth:1.2,count:8";

std::string with_eight(const std::string& pattern) { return pattern + kEight; }

LayersResult layered_box(const std::string& pattern, int n = 5) {
  return add_layers(labelled_box(n, n, n), box_target(n, n, n),
                    layers_of({with_eight(pattern).c_str()}), {});
}

void expect_sound(const LayersResult& result) {
  EXPECT_FALSE(result.mesh.find_problem());
  EXPECT_TRUE(check_topology(result.mesh).problems.empty());
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0);
  EXPECT_EQ(result.layer.size(), result.mesh.num_hexes());
}

TEST(Layers, OfAPlaneHaveExactHeights) {
  const LayersResult result = layered_box("zmin");
  expect_sound(result);
  EXPECT_EQ(result.mesh.num_hexes(), 125u + 25 * 8);
  const auto heights = layer_heights(result.mesh, result.layer, [](const Vec3& p) { return p.z; });
  const LayerSpec spec = parse_layer_spec(with_eight("zmin"));
  ASSERT_EQ(heights.size(), 8u);
  for (const auto& [layer, values] : heights) {
    EXPECT_NEAR(values.front(), spec.total() * spec.share_of(layer), 2e-3 * spec.total());
    EXPECT_NEAR(values.back(), spec.total() * spec.share_of(layer), 2e-3 * spec.total());
  }
  ASSERT_EQ(result.report.patches.size(), 1u);
  EXPECT_EQ(result.report.patches[0].patch, "zmin");
  EXPECT_DOUBLE_EQ(result.report.patches[0].covered, 1);
  EXPECT_NEAR(result.report.patches[0].area, 25, 1e-9);
  EXPECT_NEAR(result.report.patches[0].mean_first, 0.05, 1e-3);
}

TEST(Layers, WallsKeepTheirVertices) {
  const HexMesh mesh = labelled_box(5, 5, 5);
  const LayersResult result =
      add_layers(mesh, box_target(5, 5, 5), layers_of({"zmin=first:0.1,growth:1,count:3"}), {});
  for (const LabeledQuad& quad : mesh.labels.quads)
    for (VertId v : quad.verts)
      if (quad.patch == PatchId(4)) {
        EXPECT_EQ(result.mesh.positions[v], mesh.positions[v]);
      }
}

/// Where a sheet ends, the patch there keeps its plane, its area and its label, and its edge goes
/// on along the sheet.
TEST(Layers, EndInTheNeighbouringPatches) {
  const LayersResult result = layered_box("zmin");
  IdVector<PatchId, double> area(6, 0.0);
  const auto& p = result.mesh.positions;
  for (const LabeledQuad& quad : result.mesh.labels.quads) {
    const auto& q = quad.verts;
    const Vec3 normal = cross(p[q[2]] - p[q[0]], p[q[3]] - p[q[1]]) * 0.5;
    area[quad.patch] += norm(normal);
    const int axis = quad.patch.value() / 2;
    const double side = quad.patch.value() % 2 == 0 ? 0 : 5;
    for (VertId v : q) EXPECT_NEAR(p[v][axis], side, 1e-9);
    EXPECT_GT(normal[axis] * (side > 0 ? 1 : -1), 0);
  }
  for (PatchId patch : area.ids()) EXPECT_NEAR(area[patch], 25, 1e-9);
  double length = 0;
  for (const LabeledEdge& edge : result.mesh.labels.edges)
    length += distance(p[edge.verts[0]], p[edge.verts[1]]);
  EXPECT_NEAR(length, 12 * 5, 1e-9);
  EXPECT_EQ(result.mesh.labels.quads.size(), compute_hex_neighbors(result.mesh).boundary.size());
}

/// At the edges inside a box sheets meet on the bisector: all heights are those over the nearest
/// side.
TEST(Layers, MeetOnTheBisectorOfInnerEdges) {
  const LayersResult result = layered_box("*", 6);
  expect_sound(result);
  EXPECT_EQ(result.mesh.num_hexes(), 216u + 216 * 8);
  const auto heights = layer_heights(result.mesh, result.layer, [](const Vec3& p) {
    return std::min({p.x, p.y, p.z, 6 - p.x, 6 - p.y, 6 - p.z});
  });
  const LayerSpec spec = parse_layer_spec(with_eight("*"));
  for (const auto& [layer, values] : heights) {
    const double wanted = spec.total() * spec.share_of(layer);
    EXPECT_NEAR(median(values), wanted, 0.02 * wanted);
    EXPECT_GT(values.front(), 0.8 * wanted);
  }
  EXPECT_GT(summarize_quality(result.mesh).min_scaled_jacobian, 0.5);
}

TEST(Layers, AddNoIrregularEdgeInside) {
  const LayersResult result = layered_box("*", 4);
  std::map<std::array<VertId, 2>, int> num_hexes;
  std::map<std::array<VertId, 2>, bool> is_between_layers;
  for (HexId h : result.mesh.hexes.ids())
    for (const auto& e : kHexEdges) {
      const auto& v = result.mesh.hexes[h];
      const VertId a = v[static_cast<std::size_t>(e[0])], b = v[static_cast<std::size_t>(e[1])];
      const std::array<VertId, 2> edge = {std::min(a, b), std::max(a, b)};
      ++num_hexes[edge];
      const auto [it, is_new] = is_between_layers.try_emplace(edge, true);
      it->second &= result.layer[h] >= 2 && result.layer[h] <= 7;
    }
  for (const auto& [edge, count] : num_hexes)
    if (is_between_layers[edge] && count != 4) {
      EXPECT_EQ(count, 3) << "edges across the sheet at the box's corners have three hexes";
    }
}

TEST(Layers, FirstMatchingSpecCounts) {
  const LayersResult result = add_layers(
      labelled_box(5, 5, 5), box_target(5, 5, 5),
      layers_of({"zmin=first:0.1,growth:1,count:2", "z*=first:0.1,growth:1,count:4"}), {});
  expect_sound(result);
  EXPECT_EQ(result.mesh.num_hexes(), 125u + 25 * 2 + 25 * 4);
  ASSERT_EQ(result.report.patches.size(), 2u);
  EXPECT_EQ(result.report.patches[0].count, 2);
  EXPECT_EQ(result.report.patches[1].count, 4);
}

TEST(Layers, PatternsWithoutAPatchAreReported) {
  const LayersResult result = layered_box("wing");
  ASSERT_EQ(result.report.unmatched, std::vector<std::string>{"wing"});
  EXPECT_EQ(result.report.names.size(), 6u);
  EXPECT_EQ(result.mesh.num_hexes(), 125u);
}

TEST(Layers, DifferentNumbersWhereWallsMeetAreLeftOut) {
  const LayersResult result = add_layers(
      labelled_box(4, 4, 4), box_target(4, 4, 4),
      layers_of({"zmin=first:0.1,growth:1,count:2", "xmin=first:0.1,growth:1,count:3"}), {});
  expect_sound(result);
  EXPECT_EQ(result.mesh.num_hexes(), 64u);
  EXPECT_LT(result.report.coverage(), 1e-9);
  std::string notes;
  for (const PatchLayers& row : result.report.patches) notes += row.note;
  EXPECT_NE(notes.find("3 layers"), std::string::npos) << notes;
  EXPECT_NE(notes.find("for 2"), std::string::npos) << notes;
}

TEST(Layers, InvertedMeshesAreRefused) {
  HexMesh mesh = labelled_box(2, 2, 2);
  mesh.positions[VertId(13)] = {5, 5, 5};  // the middle
  EXPECT_THROW(
      add_layers(mesh, box_target(2, 2, 2), layers_of({"*=first:0.1,growth:1,count:2"}), {}),
      Error);
}

MeshOptions layered(const std::string& spec, int min_level) {
  MeshOptions options;
  options.sizing.min_level = min_level;
  options.layers.specs = {parse_layer_spec(spec)};
  return options;
}

void expect_heights(const MeshResult& result, const LayerSpec& spec,
                    const std::map<int, std::vector<double>>& heights, double tolerance) {
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.verdict.quality.num_inverted, 0u);
  EXPECT_EQ(static_cast<int>(heights.size()), spec.count);
  for (const auto& [layer, values] : heights) {
    const double wanted = spec.total() * spec.share_of(layer);
    EXPECT_NEAR(median(values), wanted, tolerance * wanted) << "layer " << layer;
  }
  EXPECT_GE(result.layers.coverage(), 0.99);
}

TEST(Layers, OfASphereHaveExactHeights) {
  for (Side side : {Side::Inside, Side::Outside}) {
    const std::string spec = side == Side::Inside ? "*=first:0.008,growth:1.2,count:8"
                                                  : "*=first:0.008,growth:1.2,count:4";
    MeshOptions options = layered(spec, 4);
    options.fit.carve.side = side;
    options.fit.patch_verts = PatchVerts::OnSurface;
    const MeshResult result = mesh_surface(unit_sphere_surface(5), options, {});
    const double sign = side == Side::Inside ? 1 : -1;
    const auto heights = layer_heights(result.mesh, result.layer,
                                       [&](const Vec3& p) { return sign * (1 - norm(p)); });
    expect_heights(result, parse_layer_spec(spec), heights, 0.1);
  }
}

TEST(Layers, OfBothSidesAreInBothRegions) {
  MeshOptions options = layered("*=first:0.01,growth:1.2,count:4", 4);
  options.fit.carve.side = Side::Both;
  const MeshResult result = mesh_surface(unit_sphere_surface(3), options, {});
  EXPECT_EQ(result.verdict.quality.num_inverted, 0u);
  std::map<std::int32_t, std::size_t> num_layer_hexes;
  for (HexId h : result.mesh.hexes.ids())
    if (result.layer[h] == 1) ++num_layer_hexes[result.mesh.region[h]];
  ASSERT_EQ(num_layer_hexes.size(), 2u);
  EXPECT_EQ(num_layer_hexes.begin()->second, num_layer_hexes.rbegin()->second);
  EXPECT_GE(result.layers.coverage(), 0.99);
}

TEST(Layers, OfACylinderLeaveThroughItsEnds) {
  TriMesh tube = cylinder_surface(0, 1, 0, 3, 512);
  tube.group.assign(tube.num_tris(), 0);
  tube.group_names = {"pipe", "end"};
  for (TriId t : tube.tris.ids())
    for (VertId v : tube.tris[t])
      if (v.index() >= 1024) tube.group[t] = 1;
  const std::string spec = "pipe=first:0.005,growth:1.2,count:8";
  MeshOptions options = layered(spec, 4);
  options.fit.patch_verts = PatchVerts::OnSurface;
  const MeshResult result = mesh_surface(tube, options, {});
  const auto heights = layer_heights(result.mesh, result.layer, [](const Vec3& p) {
    return 1 - std::sqrt(p.x * p.x + p.y * p.y);
  });
  expect_heights(result, parse_layer_spec(spec), heights, 0.1);
  for (const LabeledQuad& quad : result.mesh.labels.quads)
    if (result.mesh.labels.patch_names[quad.patch].starts_with("end"))
      for (VertId v : quad.verts) {
        const double z = result.mesh.positions[v].z;
        EXPECT_LT(std::min(std::abs(z), std::abs(z - 3)), 1e-6);
      }
}

TEST(Layers, DoNotDependOnTheNumberOfThreads) {
  const HexMesh mesh = labelled_box(6, 6, 6);
  const Target target = box_target(6, 6, 6);
  const LayersOptions options = layers_of({"[xz]min=first:0.05,growth:1.2,count:8"});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return add_layers(mesh, target, options, {});
  };
  const LayersResult one = run(1), two = run(2);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(one.mesh.hexes, two.mesh.hexes);
  EXPECT_EQ(one.mesh.labels, two.mesh.labels);
}

TEST(Layers, MeshWithoutThemIsTheSame) {
  MeshOptions options;
  const MeshResult plain = mesh_surface(unit_cube_surface(), options, {});
  EXPECT_TRUE(plain.layer.empty());
  EXPECT_TRUE(plain.layers.patches.empty());
}

TEST(Layers, TooLittleCoverageFailsTheGate) {
  MeshOptions options = layered("*=first:0.5,growth:1,count:4", 3);  // 2 in a box of 1
  const MeshResult result = mesh_surface(unit_cube_surface(), options, {});
  EXPECT_TRUE(result.failures.empty());
  EXPECT_LT(result.layers.coverage(), 0.5);
  EXPECT_EQ(result.verdict.quality.num_inverted, 0u);
  options.layers.min_coverage = 0.9;
  const MeshResult judged = mesh_surface(unit_cube_surface(), options, {});
  ASSERT_EQ(judged.failures.size(), 1u);
  EXPECT_NE(judged.failures[0].find("90.0% asked for"), std::string::npos) << judged.failures[0];
}

}  // namespace
}  // namespace hexwright
