// Each coordinate of the polycube is a function over the object of its own (axis_field.h). Together
// they are nearly a map; folds, and what is uneven, are taken out by foldover-free optimisation
// with the planes of the faces free to move.
//
// Based on: Garanzha et al., "Foldover-free maps in 50 lines of code", ACM TOG 40(4), 2021.
#include "hexwright/polycube/deform.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/error.h"
#include "hexwright/geometry/similarity.h"

#include "base/words.h"
#include "polycube/labels/axis_field.h"
#include "polycube/tets/tet_boundary.h"
#include "polycube/tets/tet_locator.h"
#include "polycube/tets/unfold.h"

namespace hexwright {
namespace {

using polycube::AxisFace;
using polycube::Tie;

std::vector<AxisFace> faces_across(const TriMesh& surface, const LabelCharts& charts, int axis) {
  std::vector<AxisFace> of_chart(charts.chart_label.size());
  for (TriId t : surface.tris.ids()) {
    const auto chart = static_cast<std::size_t>(charts.chart[t]);
    if (label_axis(charts.chart_label[chart]) != axis) continue;
    const auto p = surface.corners(t);
    AxisFace& face = of_chart[chart];
    face.sign = label_sign(charts.chart_label[chart]);
    face.area += norm(cross(p[1] - p[0], p[2] - p[0])) / 2;
    face.verts.insert(face.verts.end(), surface.tris[t].begin(), surface.tris[t].end());
  }
  std::erase_if(of_chart, [](const AxisFace& face) { return face.verts.empty(); });
  for (AxisFace& face : of_chart) {
    std::sort(face.verts.begin(), face.verts.end());
    face.verts.erase(std::unique(face.verts.begin(), face.verts.end()), face.verts.end());
  }
  return of_chart;
}

// The shape that a tet strives for: its own, or where that is flat, as hexes with two faces on a
// smooth surface have it, that of the tets a cube is cut into, of equal edges in the mean. Flat
// ones would take most of the work, for nothing: on the polycube they have corners.
std::array<Vec3, 4> reference_shape(const std::array<Vec3, 4>& tet) {
  constexpr double kGoodEnough = 0.2;
  constexpr std::array<Vec3, 4> kOfCube = {Vec3{0, 0, 0.5}, Vec3{-0.5, -0.5, 0}, Vec3{-0.5, 0.5, 0},
                                           Vec3{0, 0, 0}};
  constexpr double kDetOfCube = 0.25;
  const auto rms_edge = [](const std::array<Vec3, 4>& p) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) sum += norm_sq(p[i] - p[j]) / 6;
    return std::sqrt(sum);
  };
  const double scale = rms_edge(tet) / rms_edge(kOfCube);
  if (polycube::tet_det(tet) >= kGoodEnough * kDetOfCube * scale * scale * scale) return tet;
  auto cube = kOfCube;
  for (Vec3& p : cube) p *= scale;
  return cube;
}

// Where the object is folded, and how often.
[[noreturn]] void refuse_folds(const TetMesh& object, const TetMesh& polycube) {
  std::size_t num_folded = 0;
  Vec3 first;
  for (TetId t : polycube.tets.ids())
    if (polycube::is_nonpositive(polycube, t)) {
      if (num_folded++ > 0) continue;
      for (const Vec3& p : polycube::tet_corners(object, t)) first += p * 0.25;
    }
  throw Error(ErrorCode::BadGeometry,
              "the labels lead to a polycube that folds " + std::to_string(num_folded) + " of " +
                  std::to_string(polycube.num_tets()) + " tets, the first at " + place(first) +
                  "; let faces meet there as those of a polycube do, or give the tets more room by "
                  "a smaller tolerance");
}

// All tets may be positive and a face look the wrong way: labels agree around every corner, but not
// as a whole.
void check_faces(const Deformation& result) {
  const auto& p = result.polycube.positions;
  for (TriId t : result.surface.tris.ids()) {
    const auto& f = result.surface.tris[t];
    const std::uint8_t label =
        result.charts.chart_label[static_cast<std::size_t>(result.charts.chart[t])];
    const Vec3 n = cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
    if (n[label_axis(label)] * label_sign(label) > 0) continue;
    const Vec3 at = result.surface.positions[f[0]];
    throw Error(ErrorCode::BadGeometry, "the face " + label_name(label) + " at " + place(at) +
                                            " comes to look the other way in the polycube; label "
                                            "it, or the faces around it, differently");
  }
}

void measure(const TetMesh& object, Deformation& result) {
  double object_volume = 0, volume = 0;
  for (TetId t : object.tets.ids()) {
    object_volume += polycube::tet_det(polycube::tet_corners(object, t));
    volume += polycube::tet_det(polycube::tet_corners(result.polycube, t));
  }
  result.least_det = std::numeric_limits<double>::infinity();
  for (TetId t : object.tets.ids()) {
    const double det = polycube::tet_det(polycube::tet_corners(result.polycube, t)) /
                       polycube::tet_det(polycube::tet_corners(object, t)) * object_volume / volume;
    result.least_det = std::min(result.least_det, det);
    result.greatest_det = std::max(result.greatest_det, det);
  }
}

}  // namespace

Deformation deform_to_polycube(
    const TetMesh& object, FunctionRef<std::uint8_t(const std::array<VertId, 3>& facet)> label_of,
    const Context& context) {
  Deformation result;
  result.surface.positions = object.positions;
  result.surface.tris = polycube::boundary_facets(object);
  std::vector<std::uint8_t> labels;
  for (const auto& facet : result.surface.tris) labels.push_back(label_of(facet));
  result.charts = find_label_charts(result.surface, labels);

  const Similarity frame = compute_unit_frame(result.surface);
  TetMesh unit = object;
  for (Vec3& p : unit.positions) p = frame.to_unit(p);
  result.polycube = unit;
  std::vector<Tie> ties;
  for (int axis = 0; axis < 3; ++axis) {
    auto faces = faces_across(result.surface, result.charts, axis);
    const auto field = polycube::compute_axis_field(unit, faces, context);
    for (VertId v : object.positions.ids()) result.polycube.positions[v][axis] = field[v.index()];
    for (AxisFace& face : faces) ties.push_back({axis, std::move(face.verts)});
  }
  const IdVector<VertId, std::uint8_t> free_axes(object.num_verts(), 7);
  const auto reference = [&](TetId t) { return reference_shape(polycube::tet_corners(unit, t)); };
  if (polycube::unfold(unit, free_axes, result.polycube, {ties, reference, true}, context) > 0)
    refuse_folds(object, result.polycube);
  check_faces(result);
  measure(unit, result);
  for (Vec3& p : result.polycube.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = frame.length_to_world(p[axis]);
  return result;
}

}  // namespace hexwright
