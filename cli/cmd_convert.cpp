// hexwright convert: hex meshes, surfaces and grids from one format to another.
#include <memory>

#include <fmt/format.h>

#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct ConvertCommand {
  std::string input, output;
  ElementChoice elements;
  int order = 0;  ///< 0: that of the input
  bool as_grid = false, with_sets = false;
};

const std::vector<std::string> kSurfaceExtensions = {".obj", ".off", ".stl", ".ply"};
const std::vector<std::string> kGridOnlyExtensions = {".cells", ".htg"};

/// The kind follows from the extensions; a .vtu or .mesh may hold a mesh or a grid, and counts as a
/// mesh unless the other name or --grid says otherwise; so may a .msh or .vtk hold a surface.
void run(const ConvertCommand& cmd, Program& program) {
  check_outputs({cmd.output});
  if (has_extension(cmd.input, kSurfaceExtensions) ||
      has_extension(cmd.output, kSurfaceExtensions) || is_cad_file(cmd.input)) {
    require_extension(cmd.output, kSurfaceExtensions);
    const TriMesh surface = load_surface(cmd.input, program);
    write_surface(cmd.output, surface);
    program.console.print(fmt::format("{}: {} triangles", cmd.output, surface.num_tris()));
  } else if (cmd.as_grid || has_extension(cmd.input, kGridOnlyExtensions) ||
             has_extension(cmd.output, kGridOnlyExtensions)) {
    require_extension(cmd.output, grid_extensions());
    const Grid grid = read_grid(cmd.input);
    write_grid(cmd.output, grid);
    program.console.print(fmt::format("{}: {} cells", cmd.output, grid.num_cells()));
  } else {
    HexMesh mesh = read_hex_mesh(cmd.input);
    if (cmd.order == 1) mesh.mid_nodes.reset();
    if (cmd.order == 2 && !mesh.mid_nodes) mesh.mid_nodes = make_straight_mid_nodes(mesh);
    require_mesh_format(cmd.output, cmd.elements, mesh.mid_nodes ? 2 : 1);
    WriteHexOptions options;
    options.format = cmd.elements.format;
    options.nodes_per_hex = cmd.elements.nodes_per_hex;
    options.write_sets = cmd.with_sets;
    write_mesh(cmd.output, mesh, program.console, options);
    program.console.print(fmt::format("{}: {} hexes", cmd.output, mesh.num_hexes()));
  }
}

}  // namespace

void add_convert_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<ConvertCommand>();
  CLI::App* sub = app.add_subcommand("convert", "Change the format of a mesh, surface or grid");
  sub->add_option("input", cmd->input, "Hex mesh, surface or grid")->required();
  sub->add_option("output", cmd->output, "Same kind, other extension")->required();
  sub->add_flag("--grid", cmd->as_grid, "The .vtu or .mesh file holds a grid with hanging nodes");
  sub->add_flag("--sets", cmd->with_sets,
                "VTU and VTK: quads, edges and corners also as cells behind the hexes");
  add_element_options(*sub, cmd->elements);
  sub->add_option(
         "--order", cmd->order,
         "Of the elements of a mesh: 1 leaves mid-nodes out, 2 puts those that are missing "
         "in the middle of straight edges [that of the input]")
      ->check(CLI::IsMember({1, 2}));
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n  hexwright convert a.mesh b.inp\n  hexwright convert a.vtu b.mesh --format "
      "mfem\n  hexwright convert a.stl b.obj");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
