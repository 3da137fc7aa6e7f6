// hexwright polycube-map: from a surface with a polycube labelling to a polycube map.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/labelling_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/pipeline/polycube_map.h"
#include "hexwright/polycube/polycube.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "polycube_result.h"

namespace hexwright::cli {
namespace {

struct PolycubeMapCommand {
  std::string surface, labels, object, polycube;
  PolycubeOutputs outputs;
  PolycubeMapOptions map_options;
  PolycubeOptions options;
};

void print_map(const PolycubeMapCommand& cmd, const PolycubeMap& map, Console& console) {
  const std::string files =
      cmd.object.empty() ? cmd.surface : fmt::format("{}, {}", cmd.object, cmd.polycube);
  console.print(fmt::format(
      "{}: {} tets, all positive in the object and in the polycube of {} faces and {} corners",
      files, map.object.num_tets(), map.num_charts, map.num_corners));
  console.print(fmt::format(
      "  {:.3f} % of the diagonal off the surface at most; volumes change by factors of {:.3f} to "
      "{:.3f}",
      100 * map.max_distance, map.least_stretch, map.greatest_stretch));
}

void check_arguments(const PolycubeMapCommand& cmd) {
  if (cmd.object.empty() != cmd.polycube.empty())
    throw Error(ErrorCode::BadArgument,
                "--object and --polycube are the two sides of one map; give both or neither");
  if (cmd.object.empty() && cmd.outputs.mesh.empty())
    throw Error(ErrorCode::BadArgument,
                "nothing to write; give -o for the hex mesh, or --object and --polycube for the "
                "pair of tet meshes");
  if (cmd.outputs.mesh.empty() &&
      !(cmd.outputs.report.empty() && cmd.outputs.picture.empty() && cmd.outputs.grid.empty()))
    throw Error(ErrorCode::BadArgument,
                "--report, --picture and --save-grid are of the hex mesh; give -o too");
  check_outputs({cmd.object, cmd.polycube, cmd.outputs.mesh, cmd.outputs.report,
                 cmd.outputs.picture, cmd.outputs.grid},
                {cmd.surface, cmd.labels});
  require_extension(cmd.object, {".mesh", ".vtk"});
  require_extension(cmd.polycube, {".mesh", ".vtk"});
  if (!cmd.outputs.mesh.empty()) check_polycube_outputs(cmd.outputs);
}

void run(const PolycubeMapCommand& cmd, Program& program) {
  check_arguments(cmd);
  const Context context = program.console.start(cmd.surface);
  const TriMesh surface = load_surface(cmd.surface, program);
  const auto labels = read_labelling(cmd.labels, surface.num_tris());
  const std::string inputs = fmt::format("{}, {}", cmd.surface, cmd.labels);
  const PolycubeMap map = naming_file(
      inputs, [&] { return make_polycube_map(surface, labels, cmd.map_options, context); });
  program.console.clear_progress();
  if (!cmd.object.empty()) {
    write_tet_mesh(cmd.object, map.object);
    write_tet_mesh(cmd.polycube, map.polycube);
  }
  print_map(cmd, map, program.console);
  if (cmd.outputs.mesh.empty()) return;
  const PolycubeResult result = naming_file(
      inputs, [&] { return mesh_polycube(map.object, map.polycube, cmd.options, context); });
  finish_polycube(cmd.outputs, inputs, result, program);
}

}  // namespace

void add_polycube_map_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<PolycubeMapCommand>();
  CLI::App* sub = app.add_subcommand("polycube-map",
                                     "Polycube map of a surface with six labels, and its hexes");
  sub->add_option("surface", cmd->surface,
                  "Closed surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF")
      ->required();
  sub->add_option("labels", cmd->labels,
                  "Text file: for each triangle, in the surface's order, 0 to 5 for +x, -x, +y, "
                  "-y, +z, -z")
      ->required();
  sub->add_option("--object", cmd->object, "Write the tets of the object: .mesh or .vtk");
  sub->add_option("--polycube", cmd->polycube, "Write the same tets deformed to the polycube");
  sub->add_option("-o,--output", cmd->outputs.mesh,
                  "Hex mesh, made of the map as by 'hexwright polycube'");
  add_options(*sub, make_option_table(cmd->map_options));
  add_options(*sub, make_option_table(cmd->options));
  add_polycube_outputs(*sub, cmd->outputs);
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n"
      "  hexwright polycube-map part.obj labels.txt --object o.mesh --polycube p.mesh\n"
      "  hexwright polycube-map part.obj labels.txt -o part.vtu --max-stretch 4%");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
