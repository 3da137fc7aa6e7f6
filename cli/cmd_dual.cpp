// hexwright dual: the conforming hex mesh of a completed grid.
#include <map>
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/report.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct DualCommand {
  std::string input, output, report, mode = "auto";
  bool no_optimize = false;
};

/// `auto` looks for blocks and takes sheets where there are none. What the mode needs is checked
/// first: a message that names the command to run is worth more than a dual that fails half-way.
void run(const DualCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report}, {cmd.input});
  require_mesh_format(cmd.output);
  const Context context = program.console.start();
  const Grid grid = read_grid(cmd.input);
  DualOptions options;
  options.optimize = !cmd.no_optimize;
  if (cmd.mode == "sheets" || (cmd.mode == "auto" && find_unpaired(grid)))
    options.mode = DualMode::Sheets;
  const Balance needed = options.mode == DualMode::Sheets ? Balance::Relaxed : Balance::Weak;
  const DualResult result = naming_file(cmd.input, [&] {
    if (const auto issue = find_unbalanced(grid, needed))
      throw Error(ErrorCode::BadGeometry,
                  issue->message + "; run 'hexwright complete' on the grid first");
    return build_dual(grid, options, context);
  });
  write_mesh_with_quality(cmd.output, result.mesh, program.console);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, dual_to_json(result.report));
  program.console.print(
      fmt::format("{}: {} hexes ({}), scaled Jacobian min {:.3f}, average {:.3f}", cmd.output,
                  result.mesh.num_hexes(), options.mode == DualMode::Blocks ? "blocks" : "sheets",
                  result.report.min_scaled_jacobian, result.report.avg_scaled_jacobian));
}

}  // namespace

void add_dual_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<DualCommand>();
  CLI::App* sub = app.add_subcommand("dual", "Conforming hex mesh of a completed grid");
  sub->add_option("input", cmd->input, "Completed grid: .cells, .htg, .vtu or .mesh")->required();
  sub->add_option("-o,--output", cmd->output, "Mesh: .vtu, .vtk, .msh, .inp, polyMesh ...")
      ->required();
  sub->add_option("--mode", cmd->mode,
                  "'blocks' needs a paired grid, 'sheets' a balanced one; 'auto' looks")
      ->check(CLI::IsMember({"auto", "blocks", "sheets"}))
      ->capture_default_str();
  sub->add_flag("--no-optimize", cmd->no_optimize, "Leave the vertices where they were made");
  sub->add_option("--report", cmd->report, "Write counts as JSON");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright dual paired.cells -o hexes.mesh");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
