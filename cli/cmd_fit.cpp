// hexwright fit: a hex mesh of the surroundings carved and fitted to a surface.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/judge_distance.h"
#include "hexwright/quality/verdict_json.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct FitCommand {
  std::string hexes, surface, features, output, report, picture;
  FitStageOptions options;
  ElementChoice elements;
  std::vector<std::string> patches;
};

/// The result is judged as `check` would judge it, and decides the exit code.
void run(const FitCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report, cmd.picture}, {cmd.hexes, cmd.surface, cmd.features});
  require_mesh_format(cmd.output, cmd.elements, cmd.options.order);
  require_extension(cmd.picture, {".png"});
  const Context context = program.console.start(cmd.surface);
  const HexMesh background = read_hex_mesh(cmd.hexes);
  const TriMesh surface = load_surface(cmd.surface, program);
  FitStageOptions wishes = cmd.options;
  load_features(cmd.features, surface, wishes.target.features);
  const Target target = naming_file(cmd.surface, [&] {
    return make_target(name_patches(TriMesh(surface), cmd.patches, program), wishes.target,
                       context);
  });
  const FitStageResult fitted = naming_file(cmd.hexes, [&] {
    FitStageResult stage =
        run_fit_stage(to_unit(background, target.frame), target, wishes, context);
    stage.to_world(target.frame);
    return stage;
  });
  const FitResult& result = fitted.fit;
  if (!cmd.report.empty()) write_file_atomically(cmd.report, fit_to_json(fitted));
  if (result.mesh.num_hexes() == 0) {
    program.console.fail(cmd.hexes +
                         ": no hex lies inside the surface; the mesh and the surface "
                         "must overlap and the hexes be smaller than the object");
    program.exit_code = FailsGate;
    return;
  }
  write_mesh_with_quality(cmd.output, result.mesh, program.console, cmd.elements);
  write_cut_picture(cmd.picture, result.mesh);
  JudgeOptions judged{.bound_gap = kBoundOfTolerance * wishes.fit.tolerance};
  if (wishes.fit.carve.side != Side::Inside) judged.quads = JudgedQuads::Labeled;
  Verdict verdict = judge(to_unit(result.mesh, target.frame), target, judged, context);
  verdict.to_world(target.frame);
  program.console.print(fmt::format("{}: {} hexes of {}", cmd.output, result.mesh.num_hexes(),
                                    background.num_hexes()));
  program.console.print_block(figures_to_text(verdict));
  if (fitted.curving) program.console.print_block(curving_to_text(*fitted.curving));
  for (const std::string& w : verdict.warnings) program.console.warn(cmd.output + ": " + w);
  for (const std::string& f : verdict.failures) program.console.fail(cmd.output + ": " + f);
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

}  // namespace

void add_fit_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<FitCommand>();
  CLI::App* sub = app.add_subcommand("fit", "Carve a hex mesh and fit it to a surface");
  sub->add_option("hexes", cmd->hexes, "Conforming hex mesh, of any program")->required();
  sub->add_option("surface", cmd->surface,
                  "Surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF")
      ->required();
  add_mesh_output_option(*sub, cmd->output);
  add_options(*sub, make_option_table(cmd->options));
  add_feature_file_option(*sub, cmd->features);
  add_patch_option(*sub, cmd->patches);
  add_element_options(*sub, cmd->elements);
  sub->add_option("--report", cmd->report, "Write what became of the features as JSON");
  add_picture_option(*sub, cmd->picture);
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright fit hexes.mesh part.stl -o part.vtu");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
