// hexwright dual: the conforming hex mesh of a completed grid.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/option_names.h"
#include "hexwright/pipeline/report.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct DualCommand {
  std::string input, output, report;
  DualStageOptions options;
};

void run(const DualCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report}, {cmd.input});
  require_mesh_format(cmd.output);
  const Context context = program.console.start();
  const Grid grid = read_grid(cmd.input);
  const DualMode mode = resolve_dual_mode(grid, cmd.options);
  const DualResult result =
      naming_file(cmd.input, [&] { return run_dual_stage(grid, cmd.options, context); });
  write_mesh_with_quality(cmd.output, result.mesh, program.console);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, dual_to_json(result.report));
  program.console.print(
      fmt::format("{}: {} hexes ({}), scaled Jacobian min {:.3f}, average {:.3f}", cmd.output,
                  result.mesh.num_hexes(), name_of(kDualModeNames, std::optional(mode)),
                  result.report.min_scaled_jacobian, result.report.avg_scaled_jacobian));
}

}  // namespace

void add_dual_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<DualCommand>();
  CLI::App* sub = app.add_subcommand("dual", "Conforming hex mesh of a completed grid");
  sub->add_option("input", cmd->input, "Completed grid: .cells, .htg, .vtu or .mesh")->required();
  add_mesh_output_option(*sub, cmd->output);
  add_options(*sub, make_option_table(cmd->options));
  sub->add_option("--report", cmd->report, "Write counts as JSON");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright dual paired.cells -o hexes.mesh");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
