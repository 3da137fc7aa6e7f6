// From a model to the surface that is meshed; models are made by hand, without a CAD library.
#include "hexwright/cad/cad_surface.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "hexwright/cad/cad_shape.h"

#include "solids.h"

namespace hexwright {
namespace {

/// Planes of a box's sides.
class BoxProjector final : public Projector {
 public:
  std::optional<ExactPoint> to_face(CadFaceId face, const Vec3& p) const override {
    const int axis = face.value() / 2;
    Vec3 point = p, normal;
    point[axis] = face.value() % 2;
    normal[axis] = face.value() % 2 ? 1 : -1;
    return ExactPoint{point, normal};
  }
  std::optional<ExactPoint> to_edge(CadEdgeId, const Vec3& p) const override {
    return ExactPoint{{p.x, 0, 0}, {1, 0, 0}};
  }
};

/// The unit cube: faces x=0, x=1, y=0 ... z=1; the edge along x at y=z=0 is sharp, those about x=1
/// are tangent, as if that side were blended into the others.
CadModel cube_model() {
  CadModel model;
  model.surface = test::box_surface({0, 0, 0}, {1, 1, 1});
  model.solids.push_back({"cube"});
  for (int k = 0; k < 6; ++k) {
    CadFace face;
    face.solid = CadSolidId(0);
    face.kind = CadSurfaceKind::Plane;
    face.axis[k / 2] = 1;
    face.origin[k / 2] = k % 2;
    face.area = 1;
    model.faces.push_back(face);
  }
  for (const TriId t : model.surface.tris.ids()) {
    const auto p = model.surface.corners(t);
    const Vec3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(n[axis]) > 0.5) model.tri_to_face.push_back(CadFaceId(2 * axis + (n[axis] > 0)));
  }
  const auto vert_at = [&](const Vec3& p) {
    for (const VertId v : model.surface.positions.ids())
      if (model.surface.positions[v] == p) return v;
    return VertId();
  };
  CadEdge sharp;
  sharp.faces = {CadFaceId(2), CadFaceId(4)};
  sharp.angle = std::numbers::pi / 2;
  sharp.verts = {vert_at({0, 0, 0}), vert_at({1, 0, 0})};
  model.edges.push_back(sharp);
  for (int other = 2; other < 6; ++other) {
    CadEdge tangent;
    tangent.kind = CadEdgeClass::Tangent;
    tangent.faces = {CadFaceId(1), CadFaceId(other)};
    tangent.verts = {vert_at({1, 0, 0}), vert_at({1, 1, 0})};
    model.edges.push_back(tangent);
  }
  model.verts = {vert_at({0, 0, 0}), vert_at({1, 0, 0})};
  model.projector = std::make_shared<BoxProjector>();
  return model;
}

std::size_t num_names(const CadSurface& surface) { return surface.surface.group_names.size(); }

TEST(CadSurface, JoinsFacesThatMeetSmoothly) {
  const CadModel model = cube_model();
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model));
  EXPECT_EQ(num_names(surface), 2u);  // x=0 alone, the others with x=1
  EXPECT_EQ(surface.face_to_patch[CadFaceId(0)], "face_1");
  for (int k = 1; k < 6; ++k) EXPECT_EQ(surface.face_to_patch[CadFaceId(k)], "face_2");
  ASSERT_EQ(surface.feature_segments.size(), 1u);
}

TEST(CadSurface, KeepsFacesOfDifferentNamesApart) {
  CadModel model = cube_model();
  model.faces[CadFaceId(3)].name = "inlet";
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model));
  EXPECT_EQ(num_names(surface), 3u);
  EXPECT_EQ(surface.face_to_patch[CadFaceId(3)], "inlet");
  EXPECT_EQ(surface.face_to_patch[CadFaceId(2)], "face_2");
}

TEST(CadSurface, SplitsTangentFacesOnRequest) {
  const CadModel model = cube_model();
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model), {true});
  EXPECT_EQ(num_names(surface), 6u);
  EXPECT_EQ(surface.feature_segments.size(), 5u);
}

TEST(CadSurface, ColoursNameWhatDiffersFromMost) {
  CadModel model = cube_model();
  for (CadFace& face : model.faces) face.color = CadColor{128, 128, 128};
  EXPECT_EQ(num_names(make_cad_surface(model, faces_as_groups(model))), 2u);
  model.faces[CadFaceId(4)].color = CadColor{255, 0, 0};
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model));
  EXPECT_EQ(surface.face_to_patch[CadFaceId(4)], "color_ff0000");
}

TEST(CadSurface, RulesPickFacesByWhatTheyAre) {
  CadModel model = cube_model();
  model.faces[CadFaceId(5)].kind = CadSurfaceKind::Cylinder;
  model.faces[CadFaceId(5)].radius = 5.001;
  PatchRule rule = parse_patch_rule("bore=cylinder:r=5");
  find_faces(model, rule);
  EXPECT_EQ(rule.conditions[0].groups, std::vector<std::int32_t>{5});
  PatchRule by_name = parse_patch_rule("base=face:face_1");
  find_faces(model, by_name);
  EXPECT_EQ(by_name.conditions[0].groups, std::vector<std::int32_t>{0});
  const std::vector<PatchRule> rules = {rule, by_name};
  const RuledSurface ruled = apply_patch_rules(faces_as_groups(model), rules);
  const CadSurface surface = make_cad_surface(model, ruled.surface);
  const auto& names = surface.surface.group_names;
  for (const TriId t : surface.surface.tris.ids()) {
    const std::string& name = names[static_cast<std::size_t>(surface.surface.group[t])];
    if (model.tri_to_face[t] == CadFaceId(5)) {
      EXPECT_EQ(name, "bore");
    } else if (model.tri_to_face[t] == CadFaceId(0)) {
      EXPECT_EQ(name, "base");
    }
  }
}

TEST(CadSurface, FeaturesAreThoseOfTheTopologyAlone) {
  const CadModel model = cube_model();
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model));
  FeatureOptions options;
  use_cad_features(surface, options);
  const FeatureGraph features = extract_features(surface.surface, options);
  // The border of x=0 and the sharp edge; the triangles' other right angles are none.
  EXPECT_DOUBLE_EQ(features.total_length(), 5);
}

TEST(CadShape, FindsTheFaceByTheNearestTriangle) {
  const CadModel model = cube_model();
  const CadSurface surface = make_cad_surface(model, faces_as_groups(model));
  const auto shape = make_exact_shape(model, surface);
  const auto on_top = shape->on_surface({0.5, 0.5, 1.1}, {0, 0, 1});
  ASSERT_TRUE(on_top);
  EXPECT_EQ(on_top->point, (Vec3{0.5, 0.5, 1}));
  EXPECT_EQ(on_top->direction, (Vec3{0, 0, 1}));
  // Nearer to x=1, but looking up: the top is meant.
  const auto upwards = shape->on_surface({0.99, 0.5, 0.95}, {0, 0, 1});
  ASSERT_TRUE(upwards);
  EXPECT_EQ(upwards->point.z, 1);
  EXPECT_EQ(shape->on_curve({0.3, 0.1, 0.1})->point, (Vec3{0.3, 0, 0}));
  EXPECT_EQ(*shape->on_corner({0.9, 0.2, 0}), (Vec3{1, 0, 0}));
}

}  // namespace
}  // namespace hexwright
