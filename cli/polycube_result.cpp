#include "polycube_result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"

#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

/// Keys as documented in docs/cli.md.
std::string to_json(const PolycubeReport& report, const Verdict& verdict) {
  nlohmann::ordered_json json;
  json["polycube"] = nlohmann::ordered_json::parse(polycube_to_json(report));
  json["verdict"] = nlohmann::ordered_json::parse(verdict_to_json(verdict));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print_summary(const PolycubeOutputs& outputs, const PolycubeResult& result, Console& console) {
  const PolycubeReport& r = result.report;
  console.print(fmt::format(
      "{}: {} hexes from {} cells on {} lattice cubes (spacing {:.4g}, {} "
      "charts)",
      outputs.mesh, result.mesh.num_hexes(), r.num_cells, r.num_roots, r.spacing, r.num_charts));
  console.print(
      fmt::format("  map: {} tets, not positive: {} in the object, {} in the polycube ({} after "
                  "repair); {} vertices bridged, {} "
                  "hexes inverted before the optimisation",
                  r.num_tets, r.num_nonpositive_object, r.num_nonpositive_polycube,
                  r.num_nonpositive_left, r.num_bridged, r.num_inverted_mapped));
  if (r.num_off_edges > 0)
    console.print(fmt::format(
        "  {} vertices were let off the polycube's edges so that no hex inverts", r.num_off_edges));
  if (r.num_off_surface > 0)
    console.print(fmt::format(
        "  {} boundary vertices stay off the surface, the farthest by {:.3f} % of the diagonal at "
        "({:.4g}, {:.4g}, {:.4g})",
        r.num_off_surface, 100 * r.max_off_surface, r.farthest_off.x, r.farthest_off.y,
        r.farthest_off.z));
  for (const FoldedHex& f : r.folded)
    console.print(fmt::format(
        "  inverted: hex {} at ({:.4g}, {:.4g}, {:.4g}), scaled Jacobian {:.2f}, in tet {} of the "
        "object{}",
        f.hex.value(), f.center.x, f.center.y, f.center.z, f.scaled_jacobian, f.tet.value() + 1,
        f.is_map_folded ? ", where the map is folded" : ""));
  console.print_block(figures_to_text(result.verdict));
}

}  // namespace

void add_polycube_outputs(CLI::App& cmd, PolycubeOutputs& outputs) {
  cmd.add_option("--report", outputs.report, "Write a report as JSON");
  add_picture_option(cmd, outputs.picture);
  cmd.add_option("--save-grid", outputs.grid, "Write the grid on the polycube's lattice");
}

void check_polycube_outputs(const PolycubeOutputs& outputs) {
  require_mesh_format(outputs.mesh);
  require_extension(outputs.picture, {".png"});
  require_extension(outputs.grid, grid_extensions());
}

void finish_polycube(const PolycubeOutputs& outputs, const std::string& input,
                     const PolycubeResult& result, Program& program) {
  const Verdict& verdict = result.verdict;
  program.console.clear_progress();
  write_mesh_with_quality(outputs.mesh, result.mesh, program.console);
  write_cut_picture(outputs.picture, result.mesh);
  if (!outputs.grid.empty()) write_grid(outputs.grid, result.grid);
  if (!outputs.report.empty())
    write_file_atomically(outputs.report, to_json(result.report, verdict));
  print_summary(outputs, result, program.console);
  for (const std::string& w : result.report.warnings) program.console.warn(input + ": " + w);
  for (const std::string& f : verdict.failures) program.console.fail(outputs.mesh + ": " + f);
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

}  // namespace hexwright::cli
