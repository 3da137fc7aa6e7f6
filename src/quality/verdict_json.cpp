#include "hexwright/quality/verdict_json.h"

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
          {"hanging_vertices", t.num_hanging},
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

Json to_json(const SurfaceDistance& d) {
  return {{"max", d.max_two_way()},
          {"mean", d.mean_two_way()},
          {"max_to_mesh", d.max_to_mesh},
          {"mean_to_mesh", d.mean_to_mesh},
          {"max_to_surface", d.max_to_surface},
          {"mean_to_surface", d.mean_to_surface},
          {"ignored_share", d.ignored_share},
          {"worst_on_surface", to_json(d.worst_on_surface)},
          {"worst_on_mesh", to_json(d.worst_on_mesh)}};
}

Json to_json(const FeatureRecovery& f) {
  return {{"length", f.total_length},
          {"length_share", f.length_share},
          {"corners", f.num_corners},
          {"corners_recovered", f.num_corners_recovered}};
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
  if (verdict.distance) json["distance"] = to_json(*verdict.distance);
  if (verdict.features) json["features"] = to_json(*verdict.features);
  if (verdict.surface) json["surface"] = to_json(*verdict.surface);
  return json.dump(indent);
}

}  // namespace hexwright
