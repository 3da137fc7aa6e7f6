#include "hexwright/quality/verdict_json.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

namespace hexwright {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

Json to_json(const TopologyReport& t) {
  return {{"valid", t.is_valid()},
          {"hexes", t.num_hexes},
          {"vertices", t.num_verts},
          {"boundary_quads", t.num_boundary_quads},
          {"components", t.num_components},
          {"boundary_components", t.num_boundary_components},
          {"boundary_euler_characteristic", t.boundary_euler_characteristic},
          {"genus", t.genus()},
          {"repeated_vertices", t.num_repeated_verts},
          {"nonconforming_faces", t.num_nonconforming_faces},
          {"misoriented_faces", t.num_misoriented_faces},
          {"doublets", t.num_doublets},
          {"nonmanifold_edges", t.num_nonmanifold_edges},
          {"nonmanifold_vertices", t.num_nonmanifold_verts},
          {"singular_vertices", t.num_singular_verts},
          {"hanging_vertices", t.hanging_verts.size()},
          {"contact_vertices", t.num_contact_verts},
          {"problems", t.problems}};
}

Json to_json(const QualitySummary& q) {
  Json json = {{"min_scaled_jacobian", q.min_scaled_jacobian},
               {"avg_scaled_jacobian", q.avg_scaled_jacobian},
               {"worst_hex", nullptr},
               {"inverted", q.num_inverted},
               {"not_positive_inside", q.num_not_positive},
               {"undecided_inside", q.num_undecided},
               {"volume", q.total_volume},
               {"histogram", {{"from", -1.0}, {"to", 1.0}, {"counts", q.histogram}}}};
  if (q.worst_hex.is_valid()) json["worst_hex"] = q.worst_hex.value();
  return json;
}

Json to_json(const SecondOrderQuality& q) {
  Json broken = Json::array();
  for (HexId h : q.broken) broken.push_back(h.value());
  return {{"curved_hexes", q.num_curved},
          {"not_positive", q.num_not_positive},
          {"not_positive_hexes", broken},
          {"undecided", q.num_undecided},
          {"min_jacobian_share", q.min_jacobian_share},
          {"worst_hex", q.worst_hex.is_valid() ? Json(q.worst_hex.value()) : Json(nullptr)},
          {"volume", q.total_volume}};
}

Json to_json(const SurfaceDistance& d) {
  const auto upper = [&](double bound) { return d.upper ? Json(bound) : Json(nullptr); };
  return {{"max", d.max_two_way()},
          {"max_upper_bound", upper(d.upper ? d.upper->two_way() : 0)},
          {"upper_bounds_have_excuses", d.upper ? Json(d.upper->has_excuses) : Json(nullptr)},
          {"mean", d.mean_two_way()},
          {"max_to_mesh", d.max_to_mesh},
          {"max_to_mesh_upper_bound", upper(d.upper ? d.upper->to_mesh : 0)},
          {"mean_to_mesh", d.mean_to_mesh},
          {"max_to_surface", d.max_to_surface},
          {"max_to_surface_upper_bound", upper(d.upper ? d.upper->to_surface : 0)},
          {"mean_to_surface", d.mean_to_surface},
          {"ignored_share", d.ignored_share},
          {"worst_on_surface", to_json(d.worst_on_surface)},
          {"worst_on_mesh", to_json(d.worst_on_mesh)}};
}

/// Curves that are recovered to less than this share are listed.
constexpr double kWellRecovered = 0.9;
/// Of a list of what is missed so many are written, the worst.
constexpr std::size_t kMaxListed = 20;

/// Those with the greatest length that is not recovered.
Json list_missed_curves(const FeatureRecovery& f) {
  std::vector<CurveId> missed;
  for (CurveId c : f.curves.ids())
    if (f.curves[c].length_share < kWellRecovered) missed.push_back(c);
  const auto lost = [&](CurveId c) { return f.curves[c].length * (1 - f.curves[c].length_share); };
  std::stable_sort(missed.begin(), missed.end(),
                   [&](CurveId a, CurveId b) { return lost(a) > lost(b); });
  missed.resize(std::min(missed.size(), kMaxListed));
  Json list = Json::array();
  for (CurveId c : missed)
    list.push_back({{"curve", c.value()},
                    {"length", f.curves[c].length},
                    {"length_share", f.curves[c].length_share}});
  return list;
}

/// The farthest.
Json list_missed_corners(const FeatureRecovery& f) {
  std::vector<MissedFeature> missed;
  for (const MissedFeature& m : f.missed)
    if (!m.curve.is_valid()) missed.push_back(m);
  std::stable_sort(
      missed.begin(), missed.end(),
      [](const MissedFeature& a, const MissedFeature& b) { return a.distance > b.distance; });
  missed.resize(std::min(missed.size(), kMaxListed));
  Json list = Json::array();
  for (const MissedFeature& m : missed)
    list.push_back({{"position", to_json(m.position)}, {"distance", m.distance}});
  return list;
}

Json to_json(const FeatureRecovery& f) {
  return {{"length", f.total_length},
          {"length_share", f.length_share},
          {"corners", f.num_corners},
          {"corners_recovered", f.num_corners_recovered},
          {"missed_corners", list_missed_corners(f)},
          {"missed_curves", list_missed_curves(f)}};
}

Json to_json(const SurfaceTopology& s) {
  return {{"components", s.num_components},
          {"euler_characteristic", s.euler_characteristic},
          {"genus", s.is_closed_manifold() ? Json(s.genus()) : Json(nullptr)},
          {"closed_manifold", s.is_closed_manifold()},
          {"boundary_edges", s.num_boundary_edges},
          {"nonmanifold_edges", s.num_nonmanifold_edges},
          {"nonmanifold_vertices", s.num_nonmanifold_verts}};
}

}  // namespace

std::string verdict_to_json(const Verdict& verdict, int indent) {
  Json json = {{"valid", verdict.is_valid()},
               {"failures", verdict.failures},
               {"warnings", verdict.warnings},
               {"topology", to_json(verdict.topology)},
               {"quality", to_json(verdict.quality)}};
  if (verdict.second_order) json["second_order"] = to_json(*verdict.second_order);
  if (verdict.volume_error) json["volume_error"] = *verdict.volume_error;
  if (verdict.distance) json["distance"] = to_json(*verdict.distance);
  if (verdict.features) json["features"] = to_json(*verdict.features);
  if (verdict.surface) json["surface"] = to_json(*verdict.surface);
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hexwright
