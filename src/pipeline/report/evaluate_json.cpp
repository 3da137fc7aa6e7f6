// A model's evaluation as JSON.
//
// One record per line when not indented (JSON Lines), so that a run that is cut short leaves whole
// records. Parts that were not run are absent, parts that failed hold their message.
#include <nlohmann/json.hpp>

#include "hexwright/pipeline/evaluate.h"
#include "hexwright/pipeline/option_names.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"

namespace hexwright {
namespace {

using Json = nlohmann::ordered_json;

Json describe_method(const MethodRecord& m) {
  if (!m.has_grid()) return {{"failure", m.failure}};
  Json json = {{"cells", m.report.num_output_cells},
               {"growth", m.growth()},
               {"relative_growth", m.relative_growth()},
               {"cells_per_level", m.cells_per_level},
               {"seconds", m.seconds},
               {"gap", m.report.gap}};
  if (m.dual) {
    json["hexes"] = m.dual->num_hexes;
    json["hexes_min_sj"] = m.dual->min_scaled_jacobian;
    json["hexes_avg_sj"] = m.dual->avg_scaled_jacobian;
    json["dual_seconds"] = m.dual_seconds;
  }
  if (!m.failure.empty()) json["failure"] = m.failure;
  return json;
}

Json describe_mesh(const MeshResult& r) {
  Json json = {{"valid", r.failures.empty()},    {"failures", r.failures},
               {"warnings", r.warnings},         {"hexes", r.mesh.num_hexes()},
               {"vertices", r.mesh.num_verts()}, {"rounds", r.num_rounds},
               {"best_round", r.best_round},     {"seconds", r.seconds}};
  for (const StageRecord& stage : r.stages) json["stages"][stage.name] = stage.seconds;
  json["verdict"] = Json::parse(verdict_to_json(r.verdict, -1));
  return json;
}

}  // namespace

std::string record_to_json(const ModelRecord& record, int indent) {
  Json json = {{"surface", {{"vertices", record.num_verts}, {"triangles", record.num_tris}}},
               {"input",
                {{"cells", record.input.num_cells()},
                 {"cells_per_level", record.input_cells_per_level},
                 {"hit_cell_budget", record.hit_cell_budget},
                 {"seconds", record.sizing_seconds}}}};
  for (int m = 0; m < kNumMethods; ++m)
    if (record.methods[m].has_grid() || !record.methods[m].failure.empty())
      json["methods"][evaluated_methods()[m].key] = describe_method(record.methods[m]);
  if (record.mesh) json["mesh"] = describe_mesh(*record.mesh);
  if (!record.mesh_failure.empty()) json["mesh"] = {{"failure", record.mesh_failure}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string evaluate_options_to_json(const EvaluateOptions& o) {
  const SizingOptions& s = o.sizing;
  const Json json = {{"grid",
                      {{"sizing", name_of(kSizingNames, s.sizing)},
                       {"margin", s.margin},
                       {"min_level", s.min_level},
                       {"max_level", s.max_level},
                       {"max_cells", s.max_cells}}},
                     {"dual", o.run_dual},
                     {"mesh", o.run_mesh ? Json::parse(mesh_options_to_json(o.mesh)) : Json()}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hexwright
