#include "hexwright/quality/judge.h"

#include <nlohmann/json.hpp>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/verdict_json.h"

#include "helpers.h"

namespace hexwright {
namespace {

// The unit cube as n^3 hexes.
HexMesh cube_mesh(int n) {
  HexMesh mesh = test::box_hex_mesh(n, n, n);
  for (Vec3& p : mesh.positions) p = p / n;
  return mesh;
}

const double kDiagonal = std::sqrt(3.0);

Verdict judge_cube(const HexMesh& mesh, const JudgeOptions& options = {}) {
  return judge(mesh, wrap_target(test::unit_cube_surface()), options, {});
}

TEST(Judge, ACubeIsPerfect) {
  const Verdict verdict = judge_cube(cube_mesh(4));
  EXPECT_TRUE(verdict.is_valid());
  EXPECT_TRUE(verdict.warnings.empty());
  EXPECT_LT(verdict.distance->max_two_way(), 1e-14);
  EXPECT_NEAR(verdict.features->total_length, 12, 1e-12);
  EXPECT_NEAR(verdict.features->length_share, 1, 1e-12);
  EXPECT_EQ(verdict.features->num_corners, 8u);
  EXPECT_EQ(verdict.features->num_corners_recovered, 8u);
}

TEST(Judge, WithoutASurfaceSaysNothingOfIt) {
  const Verdict verdict = judge(cube_mesh(2), {}, {});
  EXPECT_TRUE(verdict.is_valid());
  EXPECT_FALSE(verdict.distance || verdict.features || verdict.surface);
}

TEST(Judge, TellsByHowMuchTheVolumeIsOff) {
  EXPECT_NEAR(judge_cube(cube_mesh(4)).volume_error.value(), 0, 1e-12);
  HexMesh flat = cube_mesh(4);
  for (Vec3& p : flat.positions) p.z *= 0.9;
  EXPECT_NEAR(judge_cube(flat).volume_error.value(), -0.1, 1e-12);
  // Without a closed surface there is none to compare with.
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(11);
  EXPECT_FALSE(judge(flat, wrap_target(open), {}, {}).volume_error);
}

TEST(Judge, AMovedEdgeIsALostFeature) {
  // One edge of the cube (x = y = 0) is chamfered by half a percent of the diagonal.
  HexMesh mesh = cube_mesh(4);
  for (Vec3& p : mesh.positions)
    if (p.x == 0 && p.y == 0) p.x = p.y = 0.005 * kDiagonal;
  const Verdict verdict = judge_cube(mesh);
  EXPECT_TRUE(verdict.is_valid());
  // The four mesh edges that meet it leave the tolerance at a fifth of their length 1/4.
  EXPECT_NEAR(verdict.features->length_share, (11 - 4 * 0.25 * 0.8) / 12, 0.002);
  EXPECT_EQ(verdict.features->num_corners_recovered, 6u);
  // What is missed lies on that edge and on the ends of those four; one point per tolerance.
  const double spacing = JudgeOptions{}.edge_tolerance * kDiagonal;
  EXPECT_NEAR(static_cast<double>(verdict.features->missed.size()) * spacing, 1 + 4 * 0.25 * 0.8,
              0.05);
  std::size_t num_corners = 0;
  for (const MissedFeature& m : verdict.features->missed) {
    const Vec3& p = m.position;
    EXPECT_LE(std::max(p.x, p.y), 0.25) << p.x << ' ' << p.y << ' ' << p.z;
    if (m.curve.is_valid()) continue;
    ++num_corners;
    EXPECT_NEAR(m.distance, std::sqrt(2.0) * 0.005 * kDiagonal, 1e-12);
  }
  EXPECT_EQ(num_corners, 2u);
}

TEST(Judge, SharesOfTheCurvesAddUpToThatOfTheLength) {
  HexMesh mesh = cube_mesh(4);
  for (Vec3& p : mesh.positions)
    if (p.x == 0 && p.y == 0) p.x = p.y = 0.005 * kDiagonal;
  const FeatureRecovery features = *judge_cube(mesh).features;
  ASSERT_EQ(features.curves.size(), 12u);
  double length = 0, recovered = 0;
  int num_lost = 0, num_whole = 0;
  for (const CurveRecovery& c : features.curves) {
    EXPECT_NEAR(c.turn, 0, 1e-6);
    length += c.length;
    recovered += c.length * c.length_share;
    num_lost += c.length_share == 0 ? 1 : 0;
    num_whole += c.length_share == 1 ? 1 : 0;
  }
  EXPECT_NEAR(length, features.total_length, 1e-12);
  EXPECT_NEAR(recovered, features.length_share * features.total_length, 1e-9);
  EXPECT_EQ(num_lost, 1);   // the one that was chamfered
  EXPECT_EQ(num_whole, 7);  // those that do not meet it
}

TEST(Judge, EdgesThatOnlyCrossACurveDoNotRecoverIt) {
  // A staircase across the edge x = y = 0: its vertices are on the curve, its edges are not along.
  FeatureGraph features;
  TriMesh surface = test::unit_cube_surface();
  FeatureCurve curve;
  curve.verts = {VertId(0), VertId(7)};  // the cube's diagonal
  curve.arc_length = {0, kDiagonal};
  features.curves.push_back(curve);
  const FeatureRecovery recovery =
      measure_features(cube_mesh(4), SurfaceTree(surface), features, {});
  EXPECT_EQ(recovery.length_share, 0);  // axis-parallel edges meet the diagonal at 55 degrees
}

TEST(Judge, AnInvertedHexIsAFailure) {
  HexMesh mesh = cube_mesh(3);
  mesh.positions[VertId(21)] += {1.5, 0, 0};  // an inner vertex pushed out of its hexes
  const Verdict verdict = judge(mesh, {}, {});
  EXPECT_FALSE(verdict.is_valid());
  EXPECT_TRUE(verdict.topology.is_valid());
  ASSERT_EQ(verdict.failures.size(), 1u);
  EXPECT_NE(verdict.failures[0].find("inverted"), std::string::npos);
}

TEST(Judge, ABrokenTopologyIsAFailure) {
  HexMesh mesh = cube_mesh(2);
  mesh.hexes.push_back(mesh.hexes[HexId(0)]);
  EXPECT_FALSE(judge(mesh, {}, {}).is_valid());
}

TEST(Judge, NoHexesIsAFailure) { EXPECT_FALSE(judge(HexMesh{}, {}, {}).is_valid()); }

TEST(Judge, AnIndexOutOfRangeIsAnError) {
  HexMesh mesh = cube_mesh(1);
  mesh.hexes[HexId(0)][3] = VertId(99);
  EXPECT_THROW(judge(mesh, {}, {}), Error);
}

TEST(Judge, WarnsWhenTheGenusDiffers) {
  // The middle column of a 3 x 3 x 1 box is missing: a ring, judged by a cube.
  HexMesh mesh = test::box_hex_mesh(3, 3, 1);
  for (Vec3& p : mesh.positions) p = {p.x / 3, p.y / 3, p.z};
  IdVector<HexId, std::array<VertId, 8>> ring;
  for (HexId h : mesh.hexes.ids())
    if (h != HexId(4)) ring.push_back(mesh.hexes[h]);
  mesh.hexes = ring;
  const Verdict verdict = judge_cube(mesh);
  EXPECT_TRUE(verdict.is_valid());
  ASSERT_EQ(verdict.warnings.size(), 1u);
  EXPECT_NE(verdict.warnings[0].find("genus 1"), std::string::npos);
  EXPECT_NE(verdict_to_text(verdict).find("NOT the surface's: it has 1 component and genus 0"),
            std::string::npos);
}

// A mesh around the unit cube: the box [-1, 2]^3 without its middle.
HexMesh outside_mesh() {
  HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  for (Vec3& p : mesh.positions) p -= {1, 1, 1};
  IdVector<HexId, std::array<VertId, 8>> shell;
  for (HexId h : mesh.hexes.ids())
    if (h != HexId(13)) shell.push_back(mesh.hexes[h]);
  const auto middle = mesh.hexes[HexId(13)];
  mesh.hexes = shell;
  for (const auto& f : kHexFaces)
    mesh.labels.quads.push_back(
        {{middle[f[3]], middle[f[2]], middle[f[1]], middle[f[0]]}, PatchId(0)});
  return mesh;
}

TEST(Judge, LabeledQuadsAloneStandForTheSurfaceWhenAsked) {
  JudgeOptions options;
  EXPECT_GT(judge_cube(outside_mesh(), options).distance->max_to_surface, 0.5);
  options.quads = JudgedQuads::Labeled;
  const Verdict verdict = judge_cube(outside_mesh(), options);
  EXPECT_LT(verdict.distance->max_two_way(), 1e-14);
  EXPECT_NEAR(verdict.features->length_share, 1, 1e-12);
  EXPECT_TRUE(verdict.warnings.empty());
  // The box around the surface has a boundary of its own: there is nothing to compare.
  EXPECT_EQ(verdict_to_text(verdict).find("NOT the surface's"), std::string::npos);
}

/// A mesh far away and in small units is judged as it would be about the origin, and told so.
TEST(Judge, SaysPlacesAndLengthsInTheSurfacesUnits) {
  const double scale = 1.0 / 1024;
  const Vec3 shift = {64, -32, 8};
  const auto in_world = [&](const Vec3& p) { return p * scale + shift; };
  HexMesh mesh = cube_mesh(4);
  for (Vec3& p : mesh.positions)
    if (p.x == 0 && p.y == 0) p.x = p.y = 0.005 * kDiagonal;
  const Verdict plain = judge(mesh, test::unit_cube_surface(), {}, {}, {});
  TriMesh surface = test::unit_cube_surface();
  for (Vec3& p : surface.positions) p = in_world(p);
  for (Vec3& p : mesh.positions) p = in_world(p);
  const Verdict far = judge(mesh, surface, {}, {}, {});
  EXPECT_NEAR(far.distance->max_two_way(), plain.distance->max_two_way(), 1e-9);
  EXPECT_LT(distance(far.distance->worst_on_surface, in_world(plain.distance->worst_on_surface)),
            1e-9);
  EXPECT_NEAR(far.quality.total_volume / (scale * scale * scale), plain.quality.total_volume, 1e-9);
  EXPECT_NEAR(far.features->total_length, 12 * scale, 1e-12);
  EXPECT_NEAR(far.features->curves[CurveId(0)].length, scale, 1e-12);
  ASSERT_EQ(far.features->missed.size(), plain.features->missed.size());
  ASSERT_FALSE(plain.features->missed.empty());
  for (std::size_t i = 0; i < plain.features->missed.size(); ++i) {
    const MissedFeature &there = far.features->missed[i], &here = plain.features->missed[i];
    EXPECT_LT(distance(there.position, in_world(here.position)), 1e-9);
    EXPECT_NEAR(there.distance, here.distance * scale, 1e-9);
  }
}

TEST(VerdictJson, HoldsTheNumbers) {
  const auto json = nlohmann::json::parse(verdict_to_json(judge_cube(cube_mesh(2))));
  EXPECT_TRUE(json["valid"].get<bool>());
  EXPECT_EQ(json["topology"]["hexes"], 8);
  EXPECT_EQ(json["topology"]["genus"], 0);
  EXPECT_EQ(json["quality"]["histogram"]["counts"][19], 8);
  EXPECT_EQ(json["features"]["corners_recovered"], 8);
  EXPECT_TRUE(json["surface"]["closed_manifold"].get<bool>());
}

TEST(VerdictJson, InfinityIsNull) {
  const auto json = nlohmann::json::parse(verdict_to_json(judge_cube(HexMesh{})));
  EXPECT_FALSE(json["valid"].get<bool>());
  EXPECT_TRUE(json["distance"]["max"].is_null());
  EXPECT_TRUE(json["quality"]["worst_hex"].is_null());
}

TEST(VerdictText, SaysWhatTheVerdictHolds) {
  HexMesh mesh = test::box_hex_mesh(12, 10, 10);
  std::string text = verdict_to_text(judge(mesh, {}, {}));
  EXPECT_EQ(text.rfind("VALID", 0), 0u);
  EXPECT_NE(text.find("1,200 hexes"), std::string::npos);
  EXPECT_NE(text.find("0 inverted"), std::string::npos);
  std::swap(mesh.hexes[HexId(3)][0], mesh.hexes[HexId(3)][6]);
  text = verdict_to_text(judge(mesh, {}, {}));
  EXPECT_EQ(text.rfind("NOT A VALID", 0), 0u);
  EXPECT_NE(text.find("failure: "), std::string::npos);
}

// Callers that say failures themselves take the figures alone.
TEST(VerdictText, FiguresArePartOfTheReportWithoutItsJudgement) {
  HexMesh mesh = test::box_hex_mesh(3, 2, 2);
  for (bool is_valid : {true, false}) {
    if (!is_valid) std::swap(mesh.hexes[HexId(3)][0], mesh.hexes[HexId(3)][6]);
    const Verdict verdict = judge(mesh, wrap_target(test::unit_cube_surface()), {}, {});
    const std::string figures = figures_to_text(verdict);
    EXPECT_NE(verdict_to_text(verdict).find(figures), std::string::npos);
    EXPECT_EQ(figures.find("VALID"), std::string::npos);
    EXPECT_EQ(figures.find("failure"), std::string::npos);
    for (const char* part : {"12 hexes", "scaled Jacobian", "distance", "features"})
      EXPECT_NE(figures.find(part), std::string::npos) << part << " in\n" << figures;
  }
}

}  // namespace
}  // namespace hexwright
