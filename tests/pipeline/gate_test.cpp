// The gate, reason by reason: what fails a mesh, what only warns, and in which words; when the loop
// is content; and where it refines.
#include <gtest/gtest.h>

#include "hexwright/grid/grid.h"

#include "helpers.h"
#include "pipeline/loop/loop.h"

namespace hexwright {
namespace {

class GateTest : public testing::Test {
 protected:
  GateTest() {
    context_.on_warning = [this](std::string_view text) { warnings_.emplace_back(text); };
    options_.sizing.tolerance = 0.01;
    target_.expected = {.is_known = true, .num_components = 1, .euler_characteristic = 2};
    good_.mesh = test::box_hex_mesh(1, 1, 1);
    good_.verdict.topology.num_boundary_components = 1;
    good_.verdict.topology.boundary_euler_characteristic = 2;
    good_.verdict.quality.min_scaled_jacobian = 0.9;
    good_.verdict.distance.emplace();
    good_.verdict.features.emplace();
  }

  RoundInput input() const { return {target_, options_, plan_, context_}; }

  /// Runs the gate; failures are returned, warnings left in warnings_.
  std::vector<std::string> failures_of(MeshResult result) {
    warnings_.clear();
    apply_gate(input(), round_of(result), result);
    return result.failures;
  }

  MeshResult at_distance(double distance) const {
    MeshResult result = good_;
    result.verdict.distance->max_to_surface = distance;
    return result;
  }

  /// The same as a round of the loop.
  Round round_of(const MeshResult& result) const {
    Round round;
    round.verdict = result.verdict;
    round.fit.mesh = result.mesh;
    round.fit.report = result.fit;
    return round;
  }

  Target target_ = wrap_target(test::unit_cube_surface());
  MeshOptions options_;
  StagePlan plan_;
  Context context_;
  std::vector<std::string> warnings_;
  MeshResult good_;
};

TEST_F(GateTest, AGoodMeshPassesWithoutAWord) {
  EXPECT_TRUE(failures_of(good_).empty());
  EXPECT_TRUE(warnings_.empty());
  EXPECT_TRUE(is_content(input(), round_of(good_)));
  EXPECT_TRUE(is_within_gate(input(), round_of(good_)));
}

// Up to the tolerance nothing is said, up to twice the tolerance it is a warning, then a failure.
TEST_F(GateTest, DistanceWarnsThenFails) {
  struct Step {
    double distance;
    std::size_t num_failures, num_warnings;
  };
  for (const Step& step : {Step{0.01, 0, 0}, {0.0101, 0, 1}, {0.02, 0, 1}, {0.0201, 1, 0}}) {
    const auto failures = failures_of(at_distance(step.distance));
    EXPECT_EQ(failures.size(), step.num_failures) << step.distance;
    EXPECT_EQ(warnings_.size(), step.num_warnings) << step.distance;
    const Round round = round_of(at_distance(step.distance));
    EXPECT_EQ(is_within_gate(input(), round), step.num_failures == 0);
    EXPECT_EQ(is_content(input(), round), step.num_failures + step.num_warnings == 0);
  }
  // Both directions count, and the message gives percent of the diagonal.
  MeshResult other = good_;
  other.verdict.distance->max_to_mesh = 0.05;
  const auto failures = failures_of(other);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_NE(failures[0].find("5% of the diagonal"), std::string::npos) << failures[0];
  EXPECT_NE(failures[0].find("gate's 2%"), std::string::npos) << failures[0];
}

TEST_F(GateTest, VolumeWarnsThenFailsWhereItIsKnown) {
  struct Step {
    double error;
    std::size_t num_failures, num_warnings;
  };
  for (const Step& step :
       {Step{0.004, 0, 0}, {-0.006, 0, 1}, {0.019, 0, 1}, {-0.021, 1, 0}, {0.5, 1, 0}}) {
    MeshResult off = good_;
    off.verdict.volume_error = step.error;
    const auto failures = failures_of(off);
    EXPECT_EQ(failures.size(), step.num_failures) << step.error;
    EXPECT_EQ(warnings_.size(), step.num_warnings) << step.error;
    if (step.error == -0.021) {
      EXPECT_NE(failures.at(0).find("2.1% less volume"), std::string::npos) << failures[0];
    }
    EXPECT_EQ(is_better(input(), round_of(good_), round_of(off)), std::abs(step.error) > 0.005);
  }
  MeshResult off = good_;
  off.verdict.volume_error = 0.5;
  target_.expected.num_hidden = 1;  // the surface's volume counts what lies hidden
  EXPECT_TRUE(failures_of(off).empty());
}

// The paper's sizing and meshes around the object have no goal for the distance to miss.
TEST_F(GateTest, DistanceIsNoGateWithoutADeviationSizingOrOutside) {
  options_.sizing.sizing = Sizing::Thickness;
  EXPECT_TRUE(failures_of(at_distance(0.5)).empty());
  EXPECT_EQ(warnings_.size(), 1u);
  options_.sizing.sizing = Sizing::Deviation;
  options_.fit.carve.side = Side::Outside;
  EXPECT_TRUE(failures_of(at_distance(0.5)).empty());
  EXPECT_EQ(warnings_.size(), 1u);
}

TEST_F(GateTest, LostPartsFailWithTheRemedy) {
  target_.expected.num_components = 3;
  const auto failures = failures_of(good_);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_NE(failures[0].find("1 components, the surface 3"), std::string::npos) << failures[0];
  EXPECT_NE(failures[0].find("deeper levels"), std::string::npos) << failures[0];
  EXPECT_FALSE(is_content(input(), round_of(good_)));
  // Nothing can be said where the surface does not tell, or around the object.
  target_.expected.is_known = false;
  EXPECT_TRUE(failures_of(good_).empty());
  target_.expected.is_known = true;
  options_.fit.carve.side = Side::Both;
  EXPECT_TRUE(failures_of(good_).empty());
}

// A wrong genus makes the loop go on, but alone it is the judge's warning and no failure.
TEST_F(GateTest, AWrongGenusKeepsTheLoopGoing) {
  target_.expected.euler_characteristic = 0;
  EXPECT_TRUE(failures_of(good_).empty());
  EXPECT_FALSE(is_content(input(), round_of(good_)));
  EXPECT_TRUE(is_within_gate(input(), round_of(good_)));
}

TEST_F(GateTest, PoorQualityWarnsAndInvertedHexesAreTheJudgesFailure) {
  MeshResult poor = good_;
  poor.verdict.quality.min_scaled_jacobian = options_.min_quality - 0.01;
  EXPECT_TRUE(failures_of(poor).empty());
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("scaled Jacobian is 0.190, below 0.20"), std::string::npos);
  EXPECT_FALSE(is_content(input(), round_of(poor)));

  poor.verdict.quality.num_inverted = 2;
  poor.verdict.failures = {"2 hexes are inverted"};
  poor.verdict.warnings = {"the genus differs"};
  EXPECT_EQ(failures_of(poor), poor.verdict.failures);
  EXPECT_EQ(warnings_, poor.verdict.warnings);  // and not a second word about the same hexes
  EXPECT_FALSE(is_within_gate(input(), round_of(poor)));
}

TEST_F(GateTest, UnmappedCurvesWarnWithTheirShare) {
  MeshResult some = good_;
  some.fit.num_curves = 12;
  some.fit.num_curves_mapped = 9;
  some.fit.curve_length = 8;
  some.fit.curve_length_mapped = 6;
  EXPECT_TRUE(failures_of(some).empty());
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("3 of 12 feature curves (25.0% of their length)"), std::string::npos)
      << warnings_[0];
}

TEST_F(GateTest, AnEmptyMeshHasTheJudgesReasonAlone) {
  MeshResult empty = at_distance(1);
  empty.mesh = {};
  empty.verdict.failures = {"nothing of the object was kept"};
  target_.expected.num_components = 9;
  EXPECT_EQ(failures_of(empty), empty.verdict.failures);
  EXPECT_TRUE(warnings_.empty());
}

// Curves that finer cells would follow better keep the loop going, but fail nothing.
TEST_F(GateTest, RefinableFeaturesKeepTheLoopGoing) {
  Round loose = round_of(good_);
  loose.refinable_features = {{0.5, 0.5, 0}};
  EXPECT_FALSE(is_content(input(), loose));
  EXPECT_TRUE(is_within_gate(input(), loose));
}

// is_better must order rounds: of two different ones never both, and never in a circle.
TEST_F(GateTest, TheBetterRoundIsAStrictOrder) {
  std::vector<Round> rounds;
  for (double distance : {0.005, 0.015, 0.05})
    for (double quality : {0.1, 0.5})
      for (int num_hexes : {1, 2})
        for (bool is_valid : {true, false}) {
          Round round = round_of(at_distance(distance));
          round.verdict.quality.min_scaled_jacobian = quality;
          round.fit.mesh.hexes.resize(std::size_t(num_hexes));
          if (!is_valid) round.verdict.failures = {"broken"};
          rounds.push_back(round);
        }
  const auto better = [&](std::size_t i, std::size_t j) {
    return is_better(input(), rounds[i], rounds[j]);
  };
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    EXPECT_FALSE(better(i, i));
    for (std::size_t j = 0; j < rounds.size(); ++j) {
      EXPECT_FALSE(better(i, j) && better(j, i));
      EXPECT_FALSE(rounds[j].verdict.is_valid() && !rounds[i].verdict.is_valid() && better(i, j));
      for (std::size_t k = 0; k < rounds.size(); ++k)
        EXPECT_TRUE(!better(i, j) || !better(j, k) || better(i, k)) << i << " " << j << " " << k;
    }
  }
}

// Missed points of the surface, parts lost by the carve and missed features mark the leaves that
// hold them, as deep as the loop may go.
TEST_F(GateTest, MissesMarkTheLeavesThatHoldThem) {
  Round round = round_of(good_);
  round.grid = make_root_grid({{0, 0, 0}, 1});
  for (int k = 0; k < 2; ++k)
    round.grid = split_cells(round.grid, std::vector<char>(round.grid.num_cells(), 1));
  const auto marked_boxes = [&] {
    std::vector<Box3> boxes;
    const auto marks = mark_misses(input(), round);
    for (CellId c : round.grid.cells.ids())
      if (marks[c.index()]) boxes.push_back(cell_box(round.grid, c));
    return boxes;
  };
  EXPECT_TRUE(marked_boxes().empty());
  const Vec3 hot = {0.1, 0.6, 0.9}, lost = {0.9, 0.1, 0.1};
  round.verdict.distance->hot = {hot, hot + Vec3{0.01, 0, 0}};
  round.fit.report.carve.lost = {lost};
  EXPECT_EQ(marked_boxes().size(), 1u);  // with the right topology, lost parts only by distance
  round.verdict.topology.boundary_euler_characteristic += 2;
  const auto boxes = marked_boxes();
  ASSERT_EQ(boxes.size(), 2u);
  for (const Box3& box : boxes) EXPECT_NE(box.contains(hot), box.contains(lost));

  round.refinable_features = {{0.4, 0.4, 0.4}};
  EXPECT_EQ(marked_boxes().size(), 3u);

  options_.sizing.max_level = 2;
  options_.loop_extra_levels = 0;  // the leaves are as deep as they may be
  EXPECT_TRUE(marked_boxes().empty());
}

}  // namespace
}  // namespace hexwright
