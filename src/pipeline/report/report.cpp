// Writes a run's report as JSON.
//
// Keys are an interface: docs/cli.md documents them, scripts and the bench read them. Add keys, but
// rename or remove none without a note in the changelog. Angles are degrees here, radians inside.
#include "hexwright/pipeline/report.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/base/length_unit.h"
#include "hexwright/io/set_summary.h"
#include "hexwright/pipeline/option_names.h"
#include "hexwright/pipeline/plan.h"
#include "hexwright/quality/verdict_json.h"
#include "hexwright/version.h"

namespace hexwright {
namespace {

// Ordered: reports of two runs can be compared line by line.
using Json = nlohmann::ordered_json;

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

Json describe_layer_specs(const LayersOptions& options) {
  constexpr const char* kUnits[] = {"world", "diagonal", "edge", "metre"};
  Json list = Json::array();
  for (const LayerSpec& spec : options.specs)
    list.push_back({{"pattern", spec.pattern},
                    {"first", spec.first.value},
                    {"total", spec.total()},
                    {"unit", kUnits[static_cast<std::size_t>(spec.first.unit)]},
                    {"growth", spec.growth},
                    {"count", spec.count}});
  return list;
}

Json describe_length(const Length& length) {
  if (!length.is_given()) return nullptr;
  if (length.is_share) return fmt::format("{:.6g}%", 100 * length.value);
  return length.metres > 0
             ? Json(fmt::format("{:.6g}{}", length.value, name_of_unit(length.metres)))
             : Json(length.value);
}

Json describe_domain(const SizeWishes& w) {
  if (w.box)
    return {
        {"box", {w.box->lo.x, w.box->lo.y, w.box->lo.z, w.box->hi.x, w.box->hi.y, w.box->hi.z}}};
  if (!w.margin) return nullptr;
  Json margin = Json::array();
  for (const Margin& m : *w.margin)
    margin.push_back(m.is_multiple ? Json(fmt::format("{:.6g}L", m.value)) : Json(m.value));
  return {{"margin", margin}};
}

Json describe_sizes(const SizeWishes& w) {
  Json rules = Json::array();
  for (const SizeRule& rule : w.rules) rules.push_back(rule.text);
  return {{"unit", name_of_unit(w.unit)},
          {"size", describe_length(w.size)},
          {"max_size", describe_length(w.max_size)},
          {"min_size", describe_length(w.min_size)},
          {"refine", rules},
          {"growth", w.growth},
          {"across", w.across},
          {"cells", w.cells},
          {"domain", describe_domain(w)}};
}

/// The surface is described as it was asked for in the end: some wishes follow from others.
Json describe_options(const MeshOptions& o) {
  const TargetOptions target = plan_target(o);
  return {{"parts", name_of(kPartsNames, target.prepare.parts)},
          {"min_part", target.prepare.min_part},
          {"min_gap", target.prepare.min_gap},
          {"gap", o.gap},
          {"sizing", name_of(kSizingNames, o.sizing.sizing)},
          {"tolerance", o.sizing.tolerance},
          {"sizes", describe_sizes(o.sizes)},
          {"deviation_factor", o.sizing.deviation_factor},
          {"wall_factor", o.sizing.wall_factor},
          {"crease_proximity", o.sizing.crease_proximity},
          {"margin", o.sizing.margin},
          {"min_level", o.sizing.min_level},
          {"max_level", o.sizing.max_level},
          {"loop_extra_levels", o.loop_extra_levels},
          {"max_cells", o.sizing.max_cells},
          {"pairing", name_of(kPairingNames, o.complete.pairing)},
          {"balance", name_of(kBalanceNames, resolve_balance(o.complete))},
          {"side", name_of(kSideNames, o.fit.carve.side)},
          {"padding", name_of(kPaddingNames, o.fit.padding)},
          {"vertices", name_of(kPatchVertsNames, o.fit.patch_verts)},
          {"order", o.order},
          {"placement", name_of(kPlacementNames, target.placement)},
          {"feature_angle_deg", degrees(target.features.crease_angle)},
          {"tangent_edges", o.cad.split_tangent},
          {"feature_edges_given", target.features.extra_segments.size()},
          {"layers", describe_layer_specs(o.layers)},
          {"layers_min_coverage", o.layers.min_coverage},
          {"mean_share", o.mean_share},
          {"transition_cost", o.even.transition_cost},
          {"max_rounds", o.max_rounds},
          {"most_hexes", o.most_hexes},
          {"max_hexes", o.max_hexes},
          {"max_loop_hexes", o.max_loop_hexes}};
}

Json describe_surface(const SurfaceDiagnosis& s) {
  return {{"is_closed", s.is_closed},
          {"welded_vertices", s.num_welded_verts},
          {"degenerate_triangles", s.num_degenerate_tris},
          {"duplicate_triangles", s.num_duplicate_tris},
          {"boundary_edges", s.num_boundary_edges},
          {"nonmanifold_edges", s.num_nonmanifold_edges},
          {"flipped_triangles", s.num_flipped_tris},
          {"was_inside_out", s.is_flipped_whole},
          {"united_parts", s.num_united_parts},
          {"unions", s.num_unions},
          {"gaps_closed", s.num_gaps_closed},
          {"small_parts_left_out", s.num_small_parts},
          {"small_voids_filled", s.num_small_voids},
          {"notes", s.notes}};
}

Json describe_sizing(const SizingResult& s) {
  Json sizing = {{"cells", s.grid.num_cells()},
                 {"cells_per_level", count_cells_per_level(s.grid)},
                 {"hit_cell_budget", s.hit_cell_budget}};
  for (std::size_t k = 0; k < s.splits_by_reason.size(); ++k)
    sizing["splits_by_reason"][kSplitReasons[k]] = s.splits_by_reason[k];
  return sizing;
}

Json describe_edges(const MeshResult& r) {
  const EdgeLengths& e = r.edges;
  Json edges = {{"edges", e.num_edges}, {"min", e.min},
                {"median", e.median},   {"p95", e.high},
                {"max", e.max},         {"tolerance_used", r.options.sizing.tolerance}};
  if (r.size_asked > 0) edges["asked"] = r.size_asked;
  if (r.size_used > 0) edges["size_used"] = r.size_used;
  return edges;
}

Json describe_complete(const CompleteReport& c) {
  return {{"input_cells", c.num_input_cells},
          {"cells", c.num_output_cells},
          {"splits_per_depth_input", c.num_split_input},
          {"splits_per_depth", c.num_split_output},
          {"clusters", c.num_clusters},
          {"largest_group", c.largest_group},
          {"is_optimal_per_depth", c.is_optimal_per_depth},
          {"gap", c.gap}};
}

Json describe_dual(const DualReport& d) {
  return {{"hexes", d.num_hexes},
          {"cap_hexes", d.num_cap_hexes},
          {"inverted_raw", d.num_inverted_raw},
          {"min_scaled_jacobian_raw", d.min_scaled_jacobian_raw},
          {"min_scaled_jacobian", d.min_scaled_jacobian},
          {"avg_scaled_jacobian", d.avg_scaled_jacobian}};
}

Json describe_fit(const FitReport& f) {
  Json fit = {{"hexes_carved", f.num_hexes_carved},
              {"hexes_padded", f.num_hexes_padded},
              {"flips", f.carve.num_flips},
              {"curves", f.num_curves},
              {"curves_mapped", f.num_curves_mapped},
              {"curve_length", f.curve_length},
              {"curve_length_mapped", f.curve_length_mapped},
              {"corners", f.num_corners},
              {"corners_mapped", f.num_corners_mapped},
              {"dropped_curves", Json::array()},
              {"worst_misses", Json::array()},
              {"seconds", Json::object()}};
  for (const CurveOutcome& c : f.curves)
    if (!c.is_mapped)
      fit["dropped_curves"].push_back({{"curve", c.curve.value()}, {"reason", c.reason}});
  constexpr std::size_t kMaxMisses = 20;
  for (std::size_t k = 0; k < std::min(kMaxMisses, f.misses.size()); ++k) {
    const Miss& m = f.misses[k];
    fit["worst_misses"].push_back(
        {{"position", {m.position.x, m.position.y, m.position.z}}, {"distance", m.distance}});
  }
  for (const auto& [pass, seconds] : f.seconds) fit["seconds"][pass] = seconds;
  for (const auto& [pass, seconds] : f.processor_seconds) fit["processor_seconds"][pass] = seconds;
  return fit;
}

Json describe_curving(const CurvingReport& c) {
  constexpr std::size_t kMaxListed = 20;
  Json worst = Json::array();
  for (std::size_t k = 0; k < std::min(kMaxListed, c.held_back.size()); ++k) {
    const HeldBackEdge& edge = c.held_back[k];
    worst.push_back({{"position", {edge.position.x, edge.position.y, edge.position.z}},
                     {"share", edge.share},
                     {"distance", edge.distance}});
  }
  return {{"edges", c.num_edges},         {"surface_edges", c.num_surface_edges},
          {"curved_edges", c.num_curved}, {"unmatched_edges", c.num_unmatched},
          {"max_offset", c.max_offset},   {"held_back_edges", c.held_back.size()},
          {"worst_held_back", worst}};
}

Json describe_exact(const ExactReport& e) {
  return {{"vertices", e.num_verts},
          {"exact", e.num_exact},
          {"short", e.num_short},
          {"max_before", e.max_before},
          {"max_after", e.max_after}};
}

Json describe_layers(const LayersReport& report) {
  constexpr const char* kReasons[kNumLayerLimits] = {"other", "gap", "size", "shape", "no_sheet"};
  Json patches = Json::array();
  for (const PatchLayers& row : report.patches) {
    Json reduced = Json::object();
    for (std::size_t k = 0; k < kNumLayerLimits; ++k)
      if (row.reduced[k] > 0) reduced[kReasons[k]] = row.reduced[k];
    patches.push_back({{"patch", row.patch},
                       {"count", row.count},
                       {"area", row.area},
                       {"covered", row.covered},
                       {"mean_thickness", row.mean_thickness},
                       {"least_thickness", row.least_thickness},
                       {"least_at", {row.least_at.x, row.least_at.y, row.least_at.z}},
                       {"mean_first", row.mean_first},
                       {"reduced", reduced},
                       {"note", row.note}});
  }
  return {{"coverage", report.coverage()},
          {"sheet_hexes", report.num_sheet_hexes},
          {"patches", patches},
          {"unmatched", report.unmatched}};
}

Json describe_folded(const std::vector<FoldedHex>& folded) {
  Json json = Json::array();
  for (const FoldedHex& f : folded)
    json.push_back({{"hex", f.hex.value()},
                    {"center", {f.center.x, f.center.y, f.center.z}},
                    {"scaled_jacobian", f.scaled_jacobian},
                    {"object_tet", f.tet.value() + 1},
                    {"map_is_folded_there", f.is_map_folded}});
  return json;
}

Json describe_polycube(const PolycubeReport& r) {
  return {{"tets", r.num_tets},
          {"nonpositive_tets_object", r.num_nonpositive_object},
          {"nonpositive_tets_polycube", r.num_nonpositive_polycube},
          {"nonpositive_tets_after_repair", r.num_nonpositive_left},
          {"charts", r.num_charts},
          {"unaligned_facets", r.num_unaligned_facets},
          {"max_plane_deviation", r.max_plane_deviation},
          {"spacing", r.spacing},
          {"roots", r.num_roots},
          {"sampled_cells", r.num_sampled_cells},
          {"cells", r.num_cells},
          {"bridged_vertices", r.num_bridged},
          {"inverted_after_mapping", r.num_inverted_mapped},
          {"vertices_off_edges", r.num_off_edges},
          {"vertices_off_surface", r.num_off_surface},
          {"max_off_surface", r.max_off_surface},
          {"rounds", r.num_rounds},
          {"max_distance", r.max_distance},
          {"folded_hexes", describe_folded(r.folded)},
          {"warnings", r.warnings}};
}

Json describe_stages(const MeshResult& r) {
  Json stages = Json::array();
  for (const StageRecord& s : r.stages)
    stages.push_back({{"name", s.name}, {"seconds", s.seconds}, {"counts", s.counts}});
  return stages;
}

Json describe_rounds(const MeshResult& r) {
  Json rounds = Json::array();
  for (const RoundRecord& q : r.rounds)
    rounds.push_back({{"cells", q.num_cells},
                      {"background_hexes", q.num_background},
                      {"hexes", q.num_hexes},
                      {"max_distance", q.max_distance},
                      {"mean_distance", q.mean_distance},
                      {"min_scaled_jacobian", q.min_scaled_jacobian},
                      {"avg_scaled_jacobian", q.avg_scaled_jacobian},
                      {"components", q.num_components},
                      {"genus", q.genus},
                      {"valid", q.is_valid},
                      {"inverted", q.num_inverted},
                      {"topology_met", q.is_topology_met},
                      {"marked_cells", q.num_marked},
                      {"scale", q.scale},
                      {"seconds", q.seconds}});
  return rounds;
}

}  // namespace

std::string report_to_json(const MeshResult& result, const RunInfo& run) {
  const MeshOptions& options = result.options;
  Json report = {{"program", "hexwright"},
                 {"version", HEXWRIGHT_VERSION},
                 {"compiler", __VERSION__},
                 {"input", run.input},
                 {"output", run.output},
                 {"threads", run.num_threads},
                 {"valid", result.failures.empty()},
                 {"failures", result.failures},
                 {"warnings", result.warnings},
                 {"hexes", result.mesh.num_hexes()},
                 {"vertices", result.mesh.num_verts()},
                 {"seconds", result.seconds},
                 {"peak_memory_bytes", peak_memory_bytes()},
                 {"best_round", result.best_round},
                 {"rounds", describe_rounds(result)},
                 {"stages", describe_stages(result)},
                 {"surface", describe_surface(result.surface)},
                 {"sizing", describe_sizing(result.sizing)},
                 {"complete", describe_complete(result.complete)},
                 {"cells_per_level", count_cells_per_level(result.grid)},
                 {"edges", describe_edges(result)},
                 {"dual", describe_dual(result.dual)},
                 {"fit", describe_fit(result.fit)},
                 {"verdict", Json::parse(verdict_to_json(result.verdict))},
                 {"options", describe_options(options)}};
  if (!options.layers.empty()) report["layers"] = describe_layers(result.layers);
  if (result.curving) report["curving"] = describe_curving(*result.curving);
  SetTable table = make_set_table(result.mesh);
  name_by_place(result.mesh, table);
  report["sets"] = Json::parse(sets_to_json(summarize_sets(result.mesh, table)));
  if (result.exact) report["exact_boundary"] = describe_exact(*result.exact);
  if (run.cad) report["cad"] = Json::parse(cad_to_json(*run.cad));
  for (const ChangedName& name : run.changed_names)
    report["changed_names"].push_back({{"given", name.given}, {"written", name.written}});
  return to_text(report);
}

std::string mesh_options_to_json(const MeshOptions& options) {
  return to_text(describe_options(options));
}
std::string sizing_to_json(const SizingResult& sizing) { return to_text(describe_sizing(sizing)); }
std::string complete_to_json(const CompleteReport& complete) {
  return to_text(describe_complete(complete));
}
std::string dual_to_json(const DualReport& dual) { return to_text(describe_dual(dual)); }
std::string fit_to_json(const FitStageResult& fit) {
  Json json = describe_fit(fit.fit.report);
  if (fit.curving) json["curving"] = describe_curving(*fit.curving);
  return to_text(json);
}
std::string curving_to_text(const CurvingReport& c) {
  std::string text = fmt::format("  curved     {} of {} edges on the surface, by {:.4g} at most\n",
                                 c.num_curved, c.num_surface_edges, c.max_offset);
  if (!c.held_back.empty()) {
    const HeldBackEdge& worst = c.held_back.front();
    text += fmt::format(
        "             {} held back for their elements, the worst {:.3g} off at ({:.6g}, {:.6g}, "
        "{:.6g})\n",
        c.held_back.size(), worst.distance, worst.position.x, worst.position.y, worst.position.z);
  }
  if (c.num_unmatched > 0)
    text += fmt::format("             {} straight, with no surface near\n", c.num_unmatched);
  return text;
}
std::string polycube_to_json(const PolycubeReport& polycube) {
  return to_text(describe_polycube(polycube));
}

}  // namespace hexwright
