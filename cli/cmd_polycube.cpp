// hexwright polycube: samples a polycube map adaptively.
#include <array>
#include <functional>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/quality/verdict_json.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct PolycubeCommand {
  std::string object, polycube, output, report, picture, grid;
  double max_edge = 0;                       // share of the diagonal
  std::vector<std::array<double, 7>> boxes;  // low corner, high corner, edge length; world units
  PolycubeOptions options;
};

/// Keys as documented in docs/cli.md.
std::string to_json(const PolycubeReport& report, const Verdict& verdict) {
  nlohmann::ordered_json json;
  json["polycube"] = nlohmann::ordered_json::parse(polycube_to_json(report));
  json["verdict"] = nlohmann::ordered_json::parse(verdict_to_json(verdict));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print_summary(const PolycubeCommand& cmd, const PolycubeResult& result, const Verdict& verdict,
                   Console& console) {
  const PolycubeReport& r = result.report;
  console.print(fmt::format(
      "{}: {} hexes from {} cells on {} lattice cubes (spacing {:.4g}, {} "
      "charts)",
      cmd.output, result.mesh.num_hexes(), r.num_cells, r.num_roots, r.spacing, r.num_charts));
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
  console.print_block(figures_to_text(verdict));
}

// The least of the edges asked for at a point.
std::function<double(const Vec3&)> make_size_field(const PolycubeCommand& cmd,
                                                   const TetMesh& object) {
  if (cmd.max_edge <= 0 && cmd.boxes.empty()) return {};
  Box3 box;
  for (const Vec3& p : object.positions) box.extend(p);
  const double everywhere =
      cmd.max_edge > 0 ? cmd.max_edge * box.diagonal() : std::numeric_limits<double>::infinity();
  return [everywhere, boxes = cmd.boxes](const Vec3& p) {
    double edge = everywhere;
    for (const auto& b : boxes)
      if (p.x >= b[0] && p.y >= b[1] && p.z >= b[2] && p.x <= b[3] && p.y <= b[4] && p.z <= b[5])
        edge = std::min(edge, b[6]);
    return edge;
  };
}

void run(const PolycubeCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report, cmd.picture, cmd.grid}, {cmd.object, cmd.polycube});
  require_mesh_format(cmd.output);
  require_extension(cmd.picture, {".png"});
  require_extension(cmd.grid, grid_extensions());
  const Context context = program.console.start();
  const TetMesh object = read_tet_mesh(cmd.object), polycube = read_tet_mesh(cmd.polycube);
  PolycubeOptions options = cmd.options;
  options.max_edge = make_size_field(cmd, object);
  const PolycubeResult result =
      naming_file(cmd.polycube, [&] { return mesh_polycube(object, polycube, options, context); });
  const Verdict& verdict = result.verdict;
  program.console.clear_progress();

  write_mesh_with_quality(cmd.output, result.mesh, program.console);
  write_cut_picture(cmd.picture, result.mesh);
  if (!cmd.grid.empty()) write_grid(cmd.grid, result.grid);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, to_json(result.report, verdict));
  print_summary(cmd, result, verdict, program.console);
  for (const std::string& w : result.report.warnings) program.console.warn(cmd.polycube + ": " + w);
  for (const std::string& f : verdict.failures) program.console.fail(cmd.output + ": " + f);
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

void add_size_options(CLI::App& sub, PolycubeCommand& cmd) {
  sub.add_option_function<std::string>(
      "--max-edge",
      [&cmd](const std::string& text) { cmd.max_edge = read_share("--max-edge", text); },
      "Split cells whose edges on the object are longer than this share of the diagonal");
  sub.add_option_function<std::vector<std::array<double, 7>>>(
         "--size-box",
         [&cmd](const std::vector<std::array<double, 7>>& boxes) { cmd.boxes = boxes; },
         "Longest edge inside a box of the object: x0 y0 z0 x1 y1 z1 edge; may be repeated")
      ->type_name("BOX");
}

}  // namespace

void add_polycube_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<PolycubeCommand>();
  CLI::App* sub = app.add_subcommand("polycube", "Hex mesh of an object from its polycube map");
  sub->add_option("object", cmd->object,
                  "Tet or hex mesh of the object: .mesh, .vtk, .vtu, .msh or .inp")
      ->required();
  sub->add_option("polycube", cmd->polycube, "The same elements, deformed to a polycube")
      ->required();
  add_mesh_output_option(*sub, cmd->output);
  add_options(*sub, make_option_table(cmd->options));
  add_size_options(*sub, *cmd);
  sub->add_option("--report", cmd->report, "Write a report as JSON");
  add_picture_option(*sub, cmd->picture);
  sub->add_option("--save-grid", cmd->grid, "Write the grid on the polycube's lattice");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright polycube object.mesh cube.mesh -o object.vtu --max-level 4");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
