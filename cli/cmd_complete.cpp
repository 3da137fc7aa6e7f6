// hexwright complete: balance and pairing of any adaptive grid.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/report.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct CompleteCommand {
  std::string input, output, report;
  CompleteOptions options;
};

void run(const CompleteCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report});
  require_extension(cmd.output, grid_extensions());
  const Context context = program.console.start();
  const Grid grid = read_grid(cmd.input);
  const CompleteResult result =
      naming_file(cmd.input, [&] { return complete(grid, cmd.options, context); });
  write_grid(cmd.output, result.grid);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, complete_to_json(result.report));
  program.console.print(
      fmt::format("{}: {} cells from {}", cmd.output, result.grid.num_cells(), grid.num_cells()));
}

}  // namespace

void add_complete_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<CompleteCommand>();
  CLI::App* sub = app.add_subcommand("complete", "Balance and pair an adaptive grid");
  sub->add_option("input", cmd->input, "Grid: .cells, .htg, .vtu or .mesh with hanging nodes")
      ->required();
  sub->add_option("-o,--output", cmd->output, "Grid: .cells, .htg, .vtu or .mesh")->required();
  add_complete_options(*sub, cmd->options);
  sub->add_option("--report", cmd->report, "Write counts as JSON");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright complete grid.cells -o paired.cells --pairing blocks");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
