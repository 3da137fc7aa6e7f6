// Reading CAD files: names, faces, edges, units, and what is wrong with a file.
#include "hexwright/cad/read_cad.h"

#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/cad/cad_surface.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_topology.h"

#include "geometry/tree/triangle_contacts.h"
#include "helpers.h"
#include "io/temp_folder.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

namespace fs = std::filesystem;

fs::path sample(const std::string& name) {
  return fs::path(HEXWRIGHT_SOURCE_DIR) / "data/cad" / name;
}

#define NEEDS_CAD() \
  if (!can_read_cad()) GTEST_SKIP() << "needs OpenCASCADE: run scripts/setup, then scripts/build"

/// The message of the error that reading raises; "" for none.
std::string refusal(const fs::path& path) {
  try {
    read_cad(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::size_t count(const CadModel& model, CadEdgeClass kind) {
  return static_cast<std::size_t>(std::ranges::count(model.edges, kind, &CadEdge::kind));
}

const CadFace& face_named(const CadModel& model, const std::string& name) {
  return *std::ranges::find(model.faces, name, &CadFace::name);
}

TEST(ReadCad, WithoutTheComponentSaysHowToGetIt) {
  if (can_read_cad()) GTEST_SKIP() << "the component was built";
  EXPECT_NE(refusal(sample("plate_hole.step")).find("scripts/setup cad"), std::string::npos);
}

TEST(ReadCad, KnowsFilesByNameAndByContent) {
  EXPECT_TRUE(is_cad_file("part.STP"));
  EXPECT_TRUE(is_cad_file("part.iges"));
  EXPECT_FALSE(is_cad_file("part.stl"));
  const test::TempFolder folder;
  const fs::path renamed = folder.write("renamed.txt", "ISO-10303-21;\nHEADER;");
  EXPECT_TRUE(is_cad_file(renamed));
}

TEST(ReadCad, GivesNamesFacesAndColours) {
  NEEDS_CAD();
  const CadModel model = read_cad(sample("plate_hole.step"));
  ASSERT_EQ(model.solids.size(), 1u);
  EXPECT_EQ(model.solids[CadSolidId(0)].name, "plate");
  ASSERT_EQ(model.faces.size(), 7u);
  EXPECT_EQ(describe_face(face_named(model, "fixed")), "plane x=0");
  EXPECT_EQ(describe_face(face_named(model, "bore")), "cylinder r=5 along z through (20, 10, 0)");
  const auto red = std::ranges::count_if(model.faces, [](const CadFace& f) {
    return f.color == CadColor{255, 0, 0};
  });
  EXPECT_EQ(red, 1);
  EXPECT_EQ(model.unit, "millimetre");
}

TEST(ReadCad, TrianglesAreWatertightAndWithinTheDeflection) {
  NEEDS_CAD();
  for (const char* name : {"plate_hole.step", "plate_hole.iges", "plate_hole.brep", "flange.step",
                           "filleted_block.step", "thick_cylinder.step"}) {
    SCOPED_TRACE(name);
    const CadModel model = read_cad(sample(name));
    ASSERT_FALSE(model.surface.find_problem());
    EXPECT_TRUE(compute_topology(model.surface).is_closed_manifold());
    EXPECT_GT(enclosed_volume(model.surface), 0);
    const double deflection = CadReadOptions{}.deflection * bounding_box(model.surface).diagonal();
    for (const TriId t : model.surface.tris.ids()) {
      const auto p = model.surface.corners(t);
      const Vec3 center = (p[0] + p[1] + p[2]) / 3;
      const auto exact = model.projector->to_face(model.tri_to_face[t], center);
      ASSERT_TRUE(exact);
      EXPECT_LE(distance(center, exact->point), 2 * deflection);
      EXPECT_GT(dot(exact->direction, cross(p[1] - p[0], p[2] - p[0])), 0);
    }
  }
}

TEST(ReadCad, TellsSharpEdgesFromTangentOnesAndSeams) {
  NEEDS_CAD();
  const CadModel plate = read_cad(sample("plate_hole.step"));
  EXPECT_EQ(count(plate, CadEdgeClass::Sharp), 14u);  // of the box 12, of the hole 2
  EXPECT_EQ(count(plate, CadEdgeClass::Seam), 1u);
  const CadModel block = read_cad(sample("filleted_block.step"));
  EXPECT_EQ(count(block, CadEdgeClass::Sharp), 0u);
  EXPECT_EQ(count(block, CadEdgeClass::Tangent), 48u);
}

TEST(ReadCad, ProjectsOntoFacesAndEdgesExactly) {
  NEEDS_CAD();
  const CadModel model = read_cad(sample("plate_hole.step"));
  const auto bore = CadFaceId(&face_named(model, "bore") - &model.faces[CadFaceId(0)]);
  const auto on_face = model.projector->to_face(bore, {24, 10, 2});
  ASSERT_TRUE(on_face);
  EXPECT_LT(distance(on_face->point, {25, 10, 2}), 1e-12);
  EXPECT_LT(distance(on_face->direction, {-1, 0, 0}), 1e-12);  // out of the solid, into the hole
  for (const CadEdgeId e : model.edges.ids()) {
    const CadEdge& edge = model.edges[e];
    if (edge.kind != CadEdgeClass::Sharp) continue;
    for (const VertId v : edge.verts) {
      const Vec3 p = model.surface.positions[v];
      const auto on_edge = model.projector->to_edge(e, p + Vec3{0.01, 0.02, -0.01});
      ASSERT_TRUE(on_edge);
      EXPECT_LT(distance(on_edge->point, p), 0.03);
    }
  }
}

TEST(ReadCad, BringsInchesToMillimetres) {
  NEEDS_CAD();
  const CadModel model = read_cad(sample("box_in_inches.step"));
  EXPECT_EQ(model.unit, "inch");
  EXPECT_LT(distance(bounding_box(model.surface).hi, {25.4, 50.8, 76.2}), 1e-9);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("drawn in inch"), std::string::npos);
}

TEST(ReadCad, KeepsSolidsApart) {
  NEEDS_CAD();
  const CadModel model = read_cad(sample("two_solids.step"));
  ASSERT_EQ(model.solids.size(), 3u);
  EXPECT_EQ(model.solids[CadSolidId(1)].name, "pin");
  EXPECT_EQ(compute_topology(model.surface).num_components, 3u);
}

/// Beside its tight bends the triangles of a twentieth of a percent pass through each other.
TEST(ReadCad, TrianglesThatWouldCrossAreMadeFiner) {
  NEEDS_CAD();
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  const fs::path file = test::shared_dir() / "data/cad/i07o_m7.step";
  if (!fs::exists(file)) GTEST_SKIP() << "needs the CAD files of the shared collection";
  const TriMesh surface = read_cad(file).surface;
  const TriMesh unit = to_unit(surface, compute_unit_frame(surface));
  const auto crossings = find_near_pairs(unit, 0, [&](TriId a, TriId b) {
    const auto has_area = [&](TriId t) {
      const auto p = unit.corners(t);
      return norm(cross(p[1] - p[0], p[2] - p[0])) > 1e-12;
    };
    return has_area(a) && has_area(b) &&
           find_crossing(unit.corners(a), unit.corners(b), 1e-6).has_value();
  });
  EXPECT_TRUE(crossings.empty());
}

TEST(ReadCad, RefusesBadFilesWithAReasonAndARemedy) {
  NEEDS_CAD();
  EXPECT_NE(refusal(sample("open_shell.step")).find("do not close: 4 edges"), std::string::npos);
  EXPECT_NE(refusal("no_such_file.step").find("no such file"), std::string::npos);
  const std::string whole = test::slurp(sample("plate_hole.step"));
  const test::TempFolder folder;
  const fs::path cut = folder.write("cut.step", whole.substr(0, whole.size() / 2));
  EXPECT_NE(refusal(cut).find("ends before its last line"), std::string::npos);
  const fs::path empty = folder.write("empty.step", "");
  EXPECT_NE(refusal(empty).find("empty"), std::string::npos);
  const fs::path text = folder.write("text.step", "hello");
  EXPECT_NE(refusal(text).find("no CAD file"), std::string::npos);
  const fs::path bare = folder.write(
      "bare.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n");
  EXPECT_NE(refusal(bare), "");
}

/// What OpenCASCADE makes of damage is its affair; it must come back, with a model or an Error.
TEST(ReadCad, SurvivesDamagedContent) {
  NEEDS_CAD();
  const test::TempFolder folder;
  const std::string whole = test::slurp(sample("flange.step"));
  for (std::size_t k = 0; k < 40; ++k) {
    std::string damaged = whole;
    const std::size_t at = 1500 + k * (whole.size() - 2000) / 40;
    for (std::size_t i = at; i < at + 3; ++i)
      if (damaged[i] >= '0' && damaged[i] <= '9')
        damaged[i] = static_cast<char>('0' + (k + i) % 10);
    const fs::path file = folder.write("damaged.step", damaged);
    EXPECT_NO_FATAL_FAILURE(refusal(file));
  }
}

}  // namespace
}  // namespace hexwright
