// Sheets around single hexes and rows of them, in place of layers under whole groups.
#include "fit/sheets/pad_needs.h"

#include <random>

#include "hexwright/quality/hex_quality.h"

#include "boundary_fixtures.h"
#include "boundary_problems.h"
#include "fit/carve/set_check.h"
#include "fit/carve/visible_normal.h"
#include "fit/sheets/pad.h"
#include "fit/sheets/visible.h"

namespace hexwright::fitting {
namespace {

using namespace relax;
using test::min_jacobian;
using test::problem_of;

/// A hex mesh whose whole boundary is one region without curves.
struct Smooth {
  explicit Smooth(HexMesh mesh) : state(std::move(mesh)) {
    boundary.region_to_patch.push_back(PatchId{});
    boundary.rebuild(state, {}, {});
    boundary.quad_to_region.assign(state.quads.size(), RegionId(0));
    groups.region_to_group.push_back(GroupId(0));
    groups.num_quads.push_back(state.quads.size());
    groups.num_needs.push_back(1);
  }
  PaddingInput input() const { return {features, groups, convex_share}; }
  std::vector<PaddingNeed> needs() const {
    return find_padding_needs(state, boundary, convex_share, groups);
  }
  /// Wraps the hexes that satisfy a predicate of their centres, covering all their boundary quads.
  PadOutcome wrap(const std::function<bool(const Vec3&)>& is_in) {
    SheetSets choice;
    choice.num_sheets = 1;
    for (HexId h : state.mesh.hexes.ids()) {
      Vec3 center;
      for (const Vec3& p : state.mesh.corners(h)) center += p * 0.125;
      choice.hex_to_sheet.push_back(is_in(center) ? 0 : SheetSets::kNone);
    }
    for (const HexFace& face : state.quad_face)
      choice.quad_to_sheet.push_back(choice.hex_to_sheet[face.hex]);
    return pad(state, boundary, features, choice);
  }
  FitState state;
  BoundaryState boundary;
  FeatureGraph features;
  PaddingGroups groups;
  IdVector<CurveId, double> convex_share;
};

/// Steps along x, a row of `width` hexes high and a row of `width` hexes low.
HexMesh terrace(int length, int width) {
  return test::voxels(length, [=](const Vec3& p) { return p.z < 2 || (p.z < 3 && p.x < width); });
}

TEST(PadHexes, AddsOneHexPerFaceOfTheSet) {
  // Inside, at a face, at an edge, at a corner: what is covered and what is inside all count.
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{0, 1, 1}, Vec3{0, 0, 1}, Vec3{0, 0, 0}}) {
    Smooth s(test::box_hex_mesh(3, 3, 3));
    const auto outcome = s.wrap([&](const Vec3& p) {
      return p.x > corner.x && p.x < corner.x + 1 && p.y > corner.y && p.y < corner.y + 1 &&
             p.z > corner.z && p.z < corner.z + 1;
    });
    EXPECT_EQ(outcome.is_done, std::vector<char>{1});
    EXPECT_TRUE(outcome.blocked.empty());
    EXPECT_EQ(s.state.mesh.num_hexes(), 27u + 6u);
    EXPECT_EQ(s.state.quads.size(), 54u);  // no rim: everything of the set is covered
    EXPECT_EQ(problem_of(s.state, s.boundary), "");
  }
}

TEST(PadHexes, RefusesASetThatTouchesItselfAtAnEdge) {
  Smooth s(test::box_hex_mesh(4, 4, 4));
  const HexMesh before = s.state.mesh;
  const auto outcome = s.wrap([](const Vec3& p) {
    return p.z > 1 && p.z < 2 &&
           ((p.x < 1 && p.y < 1) || (p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2));
  });
  EXPECT_EQ(outcome.is_done, std::vector<char>{0});
  EXPECT_EQ(outcome.blocked.size(), 2u);  // the ends of the edge at (1, 1)
  EXPECT_EQ(s.state.mesh.hexes, before.hexes);
  EXPECT_EQ(s.state.mesh.positions, before.positions);
}

TEST(PadHexes, IsValidForRandomBoxes) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Vec3 lo, hi;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = static_cast<double>(random() % 4);
      hi[axis] = lo[axis] + 1 + static_cast<double>(random() % 2);
    }
    Smooth s(test::box_hex_mesh(5, 5, 5));
    const auto outcome = s.wrap([&](const Vec3& p) {
      return p.x > lo.x && p.x < hi.x && p.y > lo.y && p.y < hi.y && p.z > lo.z && p.z < hi.z;
    });
    EXPECT_EQ(outcome.is_done, std::vector<char>{1});
    const Vec3 d = hi - lo;
    const auto area = static_cast<std::size_t>(2 * (d.x * d.y + d.y * d.z + d.z * d.x));
    EXPECT_EQ(s.state.mesh.num_hexes(), 125u + area);
    EXPECT_EQ(problem_of(s.state, s.boundary), "");
  }
}

TEST(LocalSheets, MendAllEdgesOfATerrace) {
  Smooth s(terrace(7, 3));
  const auto count = count_local_hexes(s.state, s.boundary, s.input());
  ASSERT_FALSE(s.needs().empty());
  const std::size_t num_before = s.state.mesh.num_hexes();
  const auto left = pad_needs(s.state, s.boundary, s.input(), IdVector<GroupId, char>(1, 1));
  EXPECT_EQ(left[GroupId(0)], 0);
  EXPECT_TRUE(s.needs().empty());
  EXPECT_GE(s.state.mesh.num_hexes(), num_before + *count[GroupId(0)]);
  EXPECT_EQ(problem_of(s.state, s.boundary), "");
}

/// The boundary quads at a vertex as a sheet, and how well a direction sees them there.
Sheet sheet_at(const FitState& state, VertId v) {
  Sheet sheet;
  for (const HexFace& face : state.quad_face) {
    const auto quad = face_verts(state.mesh, face);
    if (std::find(quad.begin(), quad.end(), v) == quad.end()) continue;
    sheet.add_face(state.mesh, face);
  }
  sheet.collect_verts();
  return sheet;
}

double visibility(const FitState& state, const Sheet& sheet, VertId v) {
  std::vector<Vec3> normals;
  for (const auto& quad : sheet.quads) {
    const auto k = static_cast<std::size_t>(std::find(quad.begin(), quad.end(), v) - quad.begin());
    const Vec3& o = state.mesh.positions[v];
    normals.push_back(normalized(cross(state.mesh.positions[quad[(k + 1) % 4]] - o,
                                       state.mesh.positions[quad[(k + 3) % 4]] - o)));
  }
  return find_visible_direction(normals).cosine;
}

/// Random octants around a vertex with random shapes: where the vertex is not seen and can be.
TEST(MakeVisible, MovesOnlyWhatIsNotSeenAndKeepsHexesValid) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> offset(-0.6, 0.6);
  int num_hidden = 0, num_mended = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    const unsigned octants = static_cast<unsigned>(random()) & 255u;
    HexMesh mesh = test::voxels(2, [&](const Vec3& p) {
      return (octants >> ((p.x > 1 ? 1 : 0) + (p.y > 1 ? 2 : 0) + (p.z > 1 ? 4 : 0)) & 1u) != 0;
    });
    const auto it = std::find(mesh.positions.begin(), mesh.positions.end(), Vec3{1, 1, 1});
    if (it == mesh.positions.end() || octants == 255u) continue;
    const VertId center(it - mesh.positions.begin());
    const FitState lattice(mesh);
    if (visibility(lattice, sheet_at(lattice, center), center) < 0.1) continue;
    for (Vec3& p : mesh.positions) p += {offset(random), offset(random), offset(random)};
    FitState state(mesh);
    const double least = min_jacobian(mesh);
    std::vector<char> all(mesh.num_hexes(), 1);
    SetCheck check(state.mesh, state.vert_to_hex, state.neighbors, true);
    if (least <= 0 || !check.is_manifold(center, all)) continue;
    const Sheet sheet = sheet_at(state, center);
    const double before = visibility(state, sheet, center);
    make_visible(state, sheet, std::vector<VertId>{center}, 0.01);
    for (VertId v : state.kind.ids()) {
      if (v == center) continue;
      EXPECT_EQ(state.mesh.positions[v], mesh.positions[v]);
    }
    if (before >= 0.01) {
      EXPECT_EQ(state.mesh.positions[center], mesh.positions[center]);
    }
    EXPECT_GE(min_jacobian(state.mesh), std::min(least, 0.02) - 1e-12);
    if (before >= 0.01) continue;
    ++num_hidden;
    const double after = visibility(state, sheet, center);
    EXPECT_GE(after, before);
    num_mended += after >= 0.01 ? 1 : 0;
  }
  EXPECT_GT(num_hidden, 8);
  EXPECT_GT(num_mended, num_hidden * 3 / 4);
}

TEST(LocalSheets, LeaveGroupsAloneThatAreNotChosen) {
  Smooth s(terrace(5, 2));
  const HexMesh before = s.state.mesh;
  pad_needs(s.state, s.boundary, s.input(), IdVector<GroupId, char>(1, 0));
  EXPECT_EQ(s.state.mesh.hexes, before.hexes);
  EXPECT_EQ(s.state.mesh.positions, before.positions);
}

}  // namespace
}  // namespace hexwright::fitting
