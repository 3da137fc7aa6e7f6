// hexwright check: judges a hex mesh, alone or against its surface, or an adaptive grid.
#include <memory>

#include <fmt/format.h>

#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/grid/complete.h"
#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/verdict_json.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct CheckCommand {
  std::string input, surface, report;
  bool as_grid = false, as_json = false;
  FeatureOptions features;
};

void check_grid(const CheckCommand& cmd, Program& program) {
  const Grid grid = read_grid(cmd.input);  // throws when the cells do not tile the roots
  Console& console = program.console;
  console.print(
      fmt::format("{}: {} cells, levels to {}", cmd.input, grid.num_cells(), grid.finest_level));
  const auto strong = find_unbalanced(grid, Balance::Strong);
  const auto weak = find_unbalanced(grid, Balance::Weak);
  const auto unpaired = find_unpaired(grid);
  console.print(fmt::format("  balance          {}", weak ? "none" : strong ? "weak" : "strong"));
  console.print(fmt::format("  pairing          {}", unpaired ? "none" : "blocks"));
  if (unpaired) console.warn(cmd.input + ": " + unpaired->message);
  if (weak) {
    console.fail(cmd.input + ": " + weak->message + "; run 'hexwright complete' on the grid");
    program.exit_code = FailsGate;
  }
}

Verdict judge_mesh(const CheckCommand& cmd, const HexMesh& mesh, Program& program) {
  const Context context = program.console.start(cmd.surface);
  JudgeOptions options;
  if (cmd.surface.empty()) {
    options.features = cmd.features;
    return judge(mesh, options, context);
  }
  const TriMesh surface = load_surface(cmd.surface, program);
  PreparedSurface prepared =
      naming_file(cmd.surface, [&] { return prepare_surface(surface, context); });
  options.features = features_for_sizing(cmd.features, bounding_box(prepared.mesh).diagonal());
  return judge(mesh, SurfaceTree(std::move(prepared.mesh)), options, context);
}

void check_mesh(const CheckCommand& cmd, Program& program) {
  const HexMesh mesh = read_hex_mesh(cmd.input);
  const Verdict verdict = judge_mesh(cmd, mesh, program);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, verdict_to_json(verdict));
  if (cmd.as_json) {
    fmt::print("{}\n", verdict_to_json(verdict));
  } else {
    program.console.print(fmt::format("{}\n{}", cmd.input, verdict_to_text(verdict)));
  }
  if (cmd.as_json || program.console.is_quiet)  // otherwise the text has said so
    for (const std::string& f : verdict.failures) program.console.fail(cmd.input + ": " + f);
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

}  // namespace

void add_check_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<CheckCommand>();
  CLI::App* sub = app.add_subcommand("check", "Judge a hex mesh of any program, or a grid");
  sub->add_option("input", cmd->input, "Hex mesh (MEDIT, VTK, VTU) or grid (.cells, .htg)")
      ->required();
  sub->add_option("surface", cmd->surface, "The surface it stands for: distances and features");
  sub->add_flag("--grid", cmd->as_grid, "The .vtu or .mesh file holds a grid with hanging nodes");
  sub->add_flag("--json", cmd->as_json, "Print the verdict as JSON");
  sub->add_option("--report", cmd->report, "Write the verdict as JSON");
  add_feature_options(*sub, cmd->features);
  add_console_options(*sub, program);
  sub->footer(
      "Exit code 0 when valid, 1 when not.\n"
      "Examples:\n"
      "  hexwright check part.vtu part.stl\n"
      "  hexwright check other.mesh --json\n"
      "  hexwright check grid.cells");
  sub->callback([cmd, &program] {
    check_outputs({cmd->report}, {cmd->input, cmd->surface});
    if (cmd->as_grid || has_extension(cmd->input, {".cells", ".htg"}))
      check_grid(*cmd, program);
    else
      check_mesh(*cmd, program);
  });
}

}  // namespace hexwright::cli
