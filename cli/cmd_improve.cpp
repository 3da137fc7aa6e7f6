// hexwright improve: better shapes, same connectivity.
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "hexwright/io/mesh_io.h"
#include "hexwright/relax/improve.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct ImproveCommand {
  std::string input, output, surface;
  ImproveOptions options;
};

void run(const ImproveCommand& cmd, Program& program) {
  check_outputs({cmd.output});
  require_mesh_format(cmd.output);
  const Context context = program.console.start();
  HexMesh mesh = read_hex_mesh(cmd.input);
  ImproveOptions options = cmd.options;
  std::optional<Target> target;
  if (!cmd.surface.empty())
    options.slide_on = &target.emplace(make_slide_target(load_surface(cmd.surface, program)));
  const ImproveReport report =
      naming_file(cmd.input, [&] { return improve(mesh, options, context); });
  write_mesh_with_quality(cmd.output, mesh, program.console);
  program.console.print(
      fmt::format("{}: scaled Jacobian min {:.4f} -> {:.4f}, average {:.4f} -> {:.4f}", cmd.output,
                  report.min_before, report.min_after, report.avg_before, report.avg_after));
  if (report.upper_bound < 1)
    program.console.print(
        fmt::format("  the held boundary allows no minimum above {:.4f} (hex {}){}",
                    report.upper_bound, report.bounding_hex.value(),
                    report.worst_is_fixed ? "; the worst corner is wholly held by it" : ""));
  if (report.min_after <= 0) {
    program.console.fail(cmd.output + ": some hexes are still inverted");
    program.exit_code = FailsGate;
  }
}

}  // namespace

void add_improve_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<ImproveCommand>();
  CLI::App* sub = app.add_subcommand("improve", "Better element shapes, same connectivity");
  sub->add_option("input", cmd->input, "Hex mesh: VTU, VTK, MEDIT, Gmsh, Abaqus, MFEM or Exodus")
      ->required();
  add_mesh_output_option(*sub, cmd->output);
  sub->add_option("--slide-on", cmd->surface,
                  "Boundary vertices slide on this surface instead of staying");
  add_options(*sub, make_option_table(cmd->options));
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright improve in.vtk -o out.vtk --slide-on part.stl");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
