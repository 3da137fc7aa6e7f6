// hexwright mesh: the whole pipeline.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/mesh_cad.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "view_file.h"

namespace hexwright::cli {
namespace {

/// What the command line says; empty names = not asked for.
struct MeshCommand {
  std::string input, output, report, picture, view, grid, features;
  ElementChoice elements;
  std::vector<std::string> patches;
  bool is_strict = false;
  MeshOptions options;
};

void print_summary(const MeshCommand& cmd, const MeshResult& result, Console& console) {
  console.print(fmt::format("{}: {} hexes, {} vertices in {:.1f} s ({} refinement{})", cmd.output,
                            result.mesh.num_hexes(), result.mesh.num_verts(), result.seconds,
                            result.num_rounds, result.num_rounds == 1 ? "" : "s"));
  for (const std::string& note : result.surface.notes) console.print("  surface: " + note);
  console.print_block(figures_to_text(result.verdict));
  if (result.curving) console.print_block(curving_to_text(*result.curving));
  if (result.exact)
    console.print(fmt::format("  {} of {} boundary vertices on the exact shape",
                              result.exact->num_exact, result.exact->num_verts));
  console.print_block(layers_to_text(result.layers));
  if (cmd.options.sizes.any())
    console.print(fmt::format("  edges: median {:.4g}, 95% up to {:.4g}, longest {:.4g}",
                              result.edges.median, result.edges.high, result.edges.max));
  for (const StageRecord& stage : result.stages)
    console.print(fmt::format("  {:<14}{:8.2f} s", stage.name, stage.seconds));
}

/// The wall layer of each hex, when layers were asked for.
std::vector<HexField> layer_field(const MeshResult& result) {
  if (result.layer.empty()) return {};
  return {{"layer", {result.layer.begin(), result.layer.end()}}};
}

/// A mesh that fails the gate is written all the same, with its failures on stderr and exit code 1:
/// to look at it is the way to see why. Only an empty one leaves no file.
void run(const MeshCommand& cmd, Program& program) {
  check_outputs({cmd.output, cmd.report, cmd.picture, cmd.view, cmd.grid},
                {cmd.input, cmd.features});
  require_extension(cmd.picture, {".png"});
  require_extension(cmd.view, {".html"});
  require_extension(cmd.grid, grid_extensions());
  require_mesh_format(cmd.output, cmd.elements, cmd.options.order);
  const Context context = program.console.start(cmd.input);
  MeshOptions options = cmd.options;
  // Grid files hold one grid, and have no axes of their own.
  if (!cmd.grid.empty()) {
    options.target.placement = Placement::AsGiven;
    options.gap = 0;
  }
  std::optional<CadInput> cad;
  TriMesh surface;
  if (is_cad_file(cmd.input)) {
    cad = load_cad(cmd.input, cmd.patches, options, program);
    surface = cad->surface.surface;
    load_features(cmd.features, surface, options.target.features);
  } else {
    surface = load_surface(cmd.input, program);
    load_features(cmd.features, surface, options.target.features);
    surface = name_patches(std::move(surface), cmd.patches, program);
  }
  MeshResult result = naming_file(cmd.input, [&] {
    return cad ? mesh_cad(*cad, options, context) : mesh_surface(surface, options, context);
  });
  program.console.clear_progress();
  if (cmd.is_strict)
    result.failures.insert(result.failures.end(), result.warnings.begin(), result.warnings.end());

  RunInfo info{cmd.input, cmd.output, num_threads()};
  if (cad) info.cad = summarize_cad(cad->model, cad->surface);
  if (result.mesh.num_hexes() > 0) {
    info.changed_names = write_mesh_with_quality(cmd.output, result.mesh, program.console,
                                                 cmd.elements, layer_field(result));
    write_cut_picture(cmd.picture, result.mesh);
    if (!cmd.view.empty())
      write_view(cmd.view, result, surface, std::filesystem::path(cmd.output).filename().string());
  }
  if (!cmd.grid.empty()) write_grid(cmd.grid, result.grid);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, report_to_json(result, info));
  if (result.mesh.num_hexes() > 0) print_summary(cmd, result, program.console);
  for (const std::string& f : result.failures) program.console.fail(cmd.input + ": " + f);
  program.exit_code = result.failures.empty() ? Valid : FailsGate;
}

}  // namespace

void add_mesh_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<MeshCommand>();
  CLI::App* sub = app.add_subcommand("mesh", "Surface in, verified all-hex mesh out");
  sub->add_option(
         "input", cmd->input,
         "Surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF; or CAD: STEP, IGES or BREP")
      ->required();
  add_mesh_output_option(*sub, cmd->output);
  add_options(*sub, make_option_table(cmd->options));
  sub->add_flag("--strict", cmd->is_strict, "Whatever is warned of fails the gate (exit code 1)");
  add_feature_file_option(*sub, cmd->features);
  add_patch_option(*sub, cmd->patches);
  add_element_options(*sub, cmd->elements);
  sub->add_option("--report", cmd->report, "Write a report as JSON");
  add_picture_option(*sub, cmd->picture);
  sub->add_option("--view", cmd->view, "Write a page to look into the mesh with (.html)");
  sub->add_option("--save-grid", cmd->grid,
                  "Write the completed grid (.cells, .htg, .vtu); the lattice then lies "
                  "as given");
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n"
      "  hexwright mesh part.stl -o part.vtu\n"
      "  hexwright mesh part.stl -o part.vtu --tolerance 0.2% --report part.json --picture "
      "part.png\n"
      "  hexwright mesh part.stl -o part.inp --order 2\n"
      "  hexwright mesh part.obj -o part.inp --sizing thickness --max-level 6");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
