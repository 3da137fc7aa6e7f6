// hexwright inspect: what a surface is, and what meshing would make of it.
#include <cstdio>
#include <memory>
#include <optional>

#include "hexwright/io/atomic_file.h"
#include "hexwright/pipeline/inspect.h"
#include "hexwright/pipeline/mesh_cad.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct InspectCommand {
  std::string input, report;
  bool as_json = false;
  MeshOptions options;
};

void run(const InspectCommand& cmd, Program& program) {
  check_outputs({cmd.report}, {cmd.input});
  const Context context = program.console.start(cmd.input);
  MeshOptions options = cmd.options;
  TriMesh surface;
  std::optional<CadSummary> cad;
  if (is_cad_file(cmd.input)) {
    const CadInput input = load_cad(cmd.input, {}, options, program);
    options = options_for_cad(options, input);
    cad = summarize_cad(input.model, input.surface);
    surface = input.surface.surface;
  } else {
    surface = load_surface(cmd.input, program);
  }
  SurfaceInspection inspection =
      naming_file(cmd.input, [&] { return inspect_surface(surface, options, context); });
  inspection.cad = std::move(cad);
  program.console.clear_progress();
  if (!cmd.report.empty()) write_file_atomically(cmd.report, inspection_to_json(inspection));
  if (cmd.as_json)
    std::fputs(inspection_to_json(inspection).c_str(), stdout);
  else
    program.console.print_block(inspection_to_text(inspection));
  program.exit_code = inspection.refusal.empty() ? Valid : FailsGate;
}

}  // namespace

void add_inspect_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<InspectCommand>();
  CLI::App* sub = app.add_subcommand("inspect", "Tell what a surface is before it is meshed");
  sub->add_option(
         "input", cmd->input,
         "Surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF; or CAD: STEP, IGES or BREP")
      ->required();
  sub->add_flag("--json", cmd->as_json, "Print as JSON");
  sub->add_option("--report", cmd->report, "Write as JSON");
  add_options(*sub, make_inspect_option_table(cmd->options));
  add_console_options(*sub, program);
  sub->footer(
      "Exit code 0 when `hexwright mesh` would take the surface, 1 when it would refuse it.\n"
      "Example:\n"
      "  hexwright inspect part.stl");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
