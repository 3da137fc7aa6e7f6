// hexwright mesh: the whole pipeline.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "picture_file.h"

namespace hexwright::cli {
namespace {

/// What the command line says; empty names = not asked for.
struct MeshCommand {
  std::string input, output, report, picture, grid, features;
  bool no_loop = false, is_strict = false;
  MeshOptions options;
};

void print_summary(const MeshCommand& cmd, const MeshResult& result, Console& console) {
  console.print(fmt::format("{}: {} hexes, {} vertices in {:.1f} s ({} refinement{})", cmd.output,
                            result.mesh.num_hexes(), result.mesh.num_verts(), result.seconds,
                            result.num_rounds, result.num_rounds == 1 ? "" : "s"));
  for (const std::string& note : result.surface.notes) console.print("  surface: " + note);
  console.print_block(figures_to_text(result.verdict));
  for (const StageRecord& stage : result.stages)
    console.print(fmt::format("  {:<14}{:8.2f} s", stage.name, stage.seconds));
}

/// A mesh that fails the gate is written all the same, with its failures on stderr and exit code 1:
/// to look at it is the way to see why. Only an empty one leaves no file.
void run(const MeshCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report, cmd.picture, cmd.grid}, {cmd.input, cmd.features});
  if (!cmd.picture.empty()) require_extension(cmd.picture, {".png"});
  if (!cmd.grid.empty()) require_extension(cmd.grid, grid_extensions());
  require_extension(cmd.output, hex_mesh_extensions());
  const Context context = program.console.start(cmd.input);
  const TriMesh surface = load_surface(cmd.input, program);
  MeshOptions options = cmd.options;
  if (cmd.no_loop) use_single_pass(options);
  // Grid files have no axes of their own.
  if (!cmd.grid.empty()) options.placement = Placement::AsGiven;
  load_features(cmd.features, surface, options.fit.features);
  MeshResult result =
      naming_file(cmd.input, [&] { return mesh_surface(surface, options, context); });
  program.console.clear_progress();
  if (cmd.is_strict)
    result.failures.insert(result.failures.end(), result.warnings.begin(), result.warnings.end());

  if (result.mesh.num_hexes() > 0) {
    write_mesh_with_quality(cmd.output, result.mesh);
    if (!cmd.picture.empty())
      write_picture(cmd.picture, result.mesh, make_default_view(result.mesh));
  }
  if (!cmd.grid.empty()) write_grid(cmd.grid, result.grid);
  if (!cmd.report.empty())
    write_file_atomically(cmd.report,
                          report_to_json(result, options, {cmd.input, cmd.output, num_threads()}));
  if (result.mesh.num_hexes() > 0) print_summary(cmd, result, program.console);
  for (const std::string& f : result.failures) program.console.fail(cmd.input + ": " + f);
  program.exit_code = result.failures.empty() ? Valid : FailsGate;
}

}  // namespace

void add_mesh_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<MeshCommand>();
  CLI::App* sub = app.add_subcommand("mesh", "Surface in, verified all-hex mesh out");
  sub->add_option("input", cmd->input, "Surface: OBJ, OFF, STL or PLY")->required();
  sub->add_option("-o,--output", cmd->output, "Mesh: .vtu, .vtk, .mesh, .msh or .inp")->required();
  add_sizing_options(*sub, cmd->options.sizing);
  // A level asked for binds the loop too.
  sub->get_option("--max-level")->each([cmd](const std::string&) {
    cmd->options.loop_extra_levels = 0;
  });
  add_placement_option(*sub, cmd->options);
  add_prepare_options(*sub, cmd->options.prepare);
  sub->add_flag("--no-loop", cmd->no_loop,
                "A single pass with a stricter a-priori sizing, instead of refining where the fit "
                "missed");
  sub->add_option("--transition-cost", cmd->options.even.transition_cost,
                  "What a cell beside another level counts more than one that is not, when levels "
                  "are evened out; 0 = never even out")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  sub->add_flag("--strict", cmd->is_strict, "Whatever is warned of fails the gate (exit code 1)");
  sub->add_option("--rounds", cmd->options.max_rounds, "At most so many refinements")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  sub->add_option("--max-hexes", cmd->options.max_hexes, "Budget of the background mesh")
      ->check(whole_count())
      ->capture_default_str();
  add_complete_options(*sub, cmd->options.complete);
  add_fit_options(*sub, cmd->options.fit);
  add_feature_file_option(*sub, cmd->features);
  sub->add_option("--report", cmd->report, "Write a report as JSON");
  sub->add_option("--picture", cmd->picture, "Write a cut through the mesh as PNG");
  sub->add_option("--save-grid", cmd->grid,
                  "Write the completed grid (.cells, .htg, .vtu); the lattice then lies "
                  "as given");
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n"
      "  hexwright mesh part.stl -o part.vtu\n"
      "  hexwright mesh part.stl -o part.vtu --tolerance 0.2% --report part.json --picture "
      "part.png\n"
      "  hexwright mesh part.obj -o part.inp --sizing thickness --max-level 6");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
