// hexwright polycube: samples a polycube map adaptively.
#include <array>
#include <functional>
#include <limits>
#include <memory>

#include "hexwright/io/mesh_io.h"
#include "hexwright/polycube/polycube.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "polycube_result.h"

namespace hexwright::cli {
namespace {

struct PolycubeCommand {
  std::string object, polycube;
  PolycubeOutputs outputs;
  double max_edge = 0;                       // share of the diagonal
  std::vector<std::array<double, 7>> boxes;  // low corner, high corner, edge length; world units
  PolycubeOptions options;
};

// The least of the edges asked for at a point.
std::function<double(const Vec3&)> make_size_field(const PolycubeCommand& cmd,
                                                   const TetMesh& object) {
  if (cmd.max_edge <= 0 && cmd.boxes.empty()) return {};
  Box3 box;
  for (const Vec3& p : object.positions) box.extend(p);
  const double everywhere =
      cmd.max_edge > 0 ? cmd.max_edge * box.diagonal() : std::numeric_limits<double>::infinity();
  return [everywhere, boxes = cmd.boxes](const Vec3& p) {
    double edge = everywhere;
    for (const auto& b : boxes)
      if (p.x >= b[0] && p.y >= b[1] && p.z >= b[2] && p.x <= b[3] && p.y <= b[4] && p.z <= b[5])
        edge = std::min(edge, b[6]);
    return edge;
  };
}

void run(const PolycubeCommand& cmd, Program& program) {
  const PolycubeOutputs& out = cmd.outputs;
  check_outputs({out.mesh, out.report, out.picture, out.grid}, {cmd.object, cmd.polycube});
  check_polycube_outputs(out);
  const Context context = program.console.start();
  const TetMesh object = read_tet_mesh(cmd.object), polycube = read_tet_mesh(cmd.polycube);
  PolycubeOptions options = cmd.options;
  options.max_edge = make_size_field(cmd, object);
  const PolycubeResult result =
      naming_file(cmd.polycube, [&] { return mesh_polycube(object, polycube, options, context); });
  finish_polycube(out, cmd.polycube, result, program);
}

void add_size_options(CLI::App& sub, PolycubeCommand& cmd) {
  sub.add_option_function<std::string>(
      "--max-edge",
      [&cmd](const std::string& text) { cmd.max_edge = read_share("--max-edge", text); },
      "Split cells whose edges on the object are longer than this share of the diagonal");
  sub.add_option_function<std::vector<std::array<double, 7>>>(
         "--size-box",
         [&cmd](const std::vector<std::array<double, 7>>& boxes) { cmd.boxes = boxes; },
         "Longest edge inside a box of the object: x0 y0 z0 x1 y1 z1 edge; may be repeated")
      ->type_name("BOX");
}

}  // namespace

void add_polycube_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<PolycubeCommand>();
  CLI::App* sub = app.add_subcommand("polycube", "Hex mesh of an object from its polycube map");
  sub->add_option("object", cmd->object,
                  "Tet or hex mesh of the object: .mesh, .vtk, .vtu, .msh or .inp")
      ->required();
  sub->add_option("polycube", cmd->polycube, "The same elements, deformed to a polycube")
      ->required();
  add_mesh_output_option(*sub, cmd->outputs.mesh);
  add_options(*sub, make_option_table(cmd->options));
  add_size_options(*sub, *cmd);
  add_polycube_outputs(*sub, cmd->outputs);
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright polycube object.mesh cube.mesh -o object.vtu --max-level 4");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
