// hexwright fit: a hex mesh of the surroundings carved and fitted to a surface.
#include <memory>

#include <fmt/format.h>

#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/io/atomic_file.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"
#include "hexwright/render/picture_sheet.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct FitCommand {
  std::string hexes, surface, features, output, report, picture;
  FitOptions options;
  std::vector<std::string> patches;
};

/// The result is judged as `check` would judge it, and decides the exit code.
void run(const FitCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report, cmd.picture}, {cmd.hexes, cmd.surface, cmd.features});
  require_mesh_format(cmd.output);
  const Context context = program.console.start(cmd.surface);
  const HexMesh background = read_hex_mesh(cmd.hexes);
  const TriMesh surface = load_surface(cmd.surface, program);
  const SurfaceTree tree = naming_file(cmd.surface, [&] {
    PreparedSurface prepared =
        prepare_surface(name_patches(TriMesh(surface), cmd.patches, program), context);
    return SurfaceTree(std::move(prepared.mesh));
  });
  FitOptions options = cmd.options;
  load_features(cmd.features, surface, options.features);
  const FitResult result =
      naming_file(cmd.hexes, [&] { return fit(background, tree, options, context); });
  if (!cmd.report.empty()) write_file_atomically(cmd.report, fit_to_json(result.report));
  if (result.mesh.num_hexes() == 0) {
    program.console.fail(cmd.hexes +
                         ": no hex lies inside the surface; the mesh and the surface "
                         "must overlap and the hexes be smaller than the object");
    program.exit_code = FailsGate;
    return;
  }
  write_mesh_with_quality(cmd.output, result.mesh, program.console);
  if (!cmd.picture.empty())
    write_png(cmd.picture, render_hex_mesh(result.mesh, make_default_view(result.mesh)));
  JudgeOptions judge_options;
  judge_options.features = features_for_sizing(options.features, tree.box().diagonal());
  const Verdict verdict = judge(result.mesh, tree, judge_options, context);
  program.console.print(fmt::format("{}: {} hexes of {}", cmd.output, result.mesh.num_hexes(),
                                    background.num_hexes()));
  program.console.print_block(figures_to_text(verdict));
  for (const std::string& w : verdict.warnings) program.console.warn(cmd.output + ": " + w);
  for (const std::string& f : verdict.failures) program.console.fail(cmd.output + ": " + f);
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

}  // namespace

void add_fit_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<FitCommand>();
  CLI::App* sub = app.add_subcommand("fit", "Carve a hex mesh and fit it to a surface");
  sub->add_option("hexes", cmd->hexes, "Conforming hex mesh, of any program")->required();
  sub->add_option("surface", cmd->surface, "Surface: OBJ, OFF, STL or PLY")->required();
  sub->add_option("-o,--output", cmd->output, "Mesh: .vtu, .vtk, .msh, .inp, polyMesh ...")
      ->required();
  add_options(*sub, make_option_table(cmd->options));
  add_feature_file_option(*sub, cmd->features);
  add_patch_option(*sub, cmd->patches);
  sub->add_option("--report", cmd->report, "Write what became of the features as JSON");
  sub->add_option("--picture", cmd->picture, "Write a cut through the mesh as PNG");
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright fit hexes.mesh part.stl -o part.vtu");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
