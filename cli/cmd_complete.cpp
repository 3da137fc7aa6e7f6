// hexwright complete: balance and pairing of any adaptive grid.
#include <memory>

#include <fmt/format.h>

#include "hexwright/grid/ilp.h"
#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/report.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

/// What the command line says.
struct CompleteCommand {
  std::string input, output, report;
  CompleteOptions options;
  std::string solver = "exact";
  double time_limit = 60;
};

/// Completion by the integer program, where the program was built with a solver for it.
CompleteResult complete_by_program(const CompleteCommand& cmd, const Grid& grid,
                                   const Context& context) {
#if HEXWRIGHT_HAS_ILP
  if (cmd.options.pairing != Pairing::Blocks)
    throw Error(ErrorCode::BadArgument, "--solver ilp and global go with --pairing blocks");
  const IlpOptions options{resolve_balance(cmd.options),
                           cmd.solver == "ilp" ? IlpScope::Depth : IlpScope::Hierarchy,
                           cmd.time_limit};
  IlpResult solved = complete_by_ilp(grid, options, context);
  CompleteResult result;
  result.report.num_input_cells = grid.num_cells();
  result.report.num_output_cells = solved.num_cells;
  result.report.is_optimal_per_depth = solved.is_optimal;
  result.report.gap = solved.num_cells - solved.lower_bound;
  result.grid = std::move(solved.grid);
  return result;
#else
  static_cast<void>(cmd);
  static_cast<void>(grid);
  static_cast<void>(context);
  throw Error(ErrorCode::BadArgument,
              "--solver ilp and global need HiGHS, which this program was built without; "
              "scripts/setup unpacks it, then scripts/build");
#endif
}

/// Outputs are checked before the work: a run of minutes must not end at a missing folder.
void run(const CompleteCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report});
  require_extension(cmd.output, grid_extensions());
  const Context context = program.console.start();
  const Grid grid = read_grid(cmd.input);
  const CompleteResult result = naming_file(cmd.input, [&] {
    return cmd.solver == "exact" ? complete(grid, cmd.options, context)
                                 : complete_by_program(cmd, grid, context);
  });
  write_grid(cmd.output, result.grid);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, complete_to_json(result.report));
  program.console.print(
      fmt::format("{}: {} cells from {}", cmd.output, result.grid.num_cells(), grid.num_cells()));
  if (!result.report.is_optimal_per_depth)
    program.console.print(
        fmt::format("not proven coarsest: up to {} cells could be saved", result.report.gap));
}

}  // namespace

void add_complete_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<CompleteCommand>();
  CLI::App* sub = app.add_subcommand("complete", "Balance and pair an adaptive grid");
  sub->add_option("input", cmd->input, "Grid: .cells, .htg, .vtu or .mesh with hanging nodes")
      ->required();
  sub->add_option("-o,--output", cmd->output, "Grid: .cells, .htg, .vtu or .mesh")->required();
  add_options(*sub, make_option_table(cmd->options));
  sub->add_option("--solver", cmd->solver,
                  "For blocks: exact labelling per depth and descent (exact), an integer program "
                  "per depth (ilp), or one for all depths (global)")
      ->check(CLI::IsMember({"exact", "ilp", "global"}))
      ->capture_default_str();
  sub->add_option("--time-limit", cmd->time_limit, "Seconds for --solver ilp and global")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub->add_option("--report", cmd->report, "Write counts as JSON");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright complete grid.cells -o paired.cells --pairing blocks");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
