// hexwright grid: the adaptive grid of a surface, before completion.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/plan.h"
#include "hexwright/pipeline/report.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct GridCommand {
  std::string input, features, output, report;
  MeshOptions options;
};

/// The loop of `mesh` is not run here; --no-loop sets the stricter criterion that stands in for it.
void run(const GridCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report}, {cmd.input, cmd.features});
  require_extension(cmd.output, grid_extensions());
  const Context context = program.console.start(cmd.input);
  const TriMesh surface = load_surface(cmd.input, program);
  MeshOptions options = cmd.options;
  load_features(cmd.features, surface, options.target.features);
  const SizingResult result =
      naming_file(cmd.input, [&] { return size_surface(surface, options, context); });
  write_grid(cmd.output, result.grid);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, sizing_to_json(result));
  program.console.print(fmt::format("{}: {} cells, levels to {}", cmd.output,
                                    result.grid.num_cells(), result.reached_level));
}

}  // namespace

void add_grid_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<GridCommand>();
  CLI::App* sub = app.add_subcommand("grid", "Adaptive grid of a surface (before completion)");
  sub->add_option("input", cmd->input,
                  "Surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF")
      ->required();
  sub->add_option("-o,--output", cmd->output, "Grid: .cells, .htg, .vtu or .mesh")->required();
  add_options(*sub, make_grid_option_table(cmd->options));
  add_feature_file_option(*sub, cmd->features);
  sub->add_option("--report", cmd->report, "Write counts as JSON");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright grid part.stl -o part.cells --sizing thickness");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
