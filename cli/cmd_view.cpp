// hexwright view: a mesh as one page to look into, in the browser.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "hexwright/io/mesh_io.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "view_file.h"

namespace hexwright::cli {
namespace {

namespace fs = std::filesystem;

struct ViewCommand {
  std::string input, surface, output;
  bool no_open = false;
  int max_whole_hexes = static_cast<int>(ViewOptions().max_whole_hexes);
};

/// In a new folder of the system's for temporary files, so that nothing is replaced.
std::string temporary_page(const std::string& input) {
  std::string folder = (fs::temp_directory_path() / "hexwright-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr)
    throw Error(ErrorCode::CannotOpen,
                fmt::format("no folder can be made for the page ({}); name a file with -o",
                            std::strerror(errno)),
                folder);
  return (fs::path(folder) / fs::path(input).stem()).string() + ".html";
}

void run(const ViewCommand& cmd, Program& program) {
  require_extension(cmd.output, {".html"});
  check_outputs({cmd.output}, {cmd.input, cmd.surface});
  const Context context = program.console.start(cmd.input);
  const HexMesh mesh = read_hex_mesh(cmd.input);
  std::optional<SurfaceTree> tree;
  if (!cmd.surface.empty()) tree.emplace(load_surface(cmd.surface, program));
  ViewOptions options;
  options.title = fs::path(cmd.input).filename().string();
  options.max_whole_hexes = static_cast<std::size_t>(cmd.max_whole_hexes);
  options.surface = tree ? &*tree : nullptr;
  const std::string output = cmd.output.empty() ? temporary_page(cmd.input) : cmd.output;
  naming_file(cmd.input, [&] { write_view(output, mesh, options); });
  const bool is_open = !cmd.no_open && open_in_browser(output);
  program.console.print(is_open || cmd.no_open ? output : output + ": open it in a browser");
}

}  // namespace

void add_view_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand("view", "Look into a hex mesh in the browser");
  sub->add_option("input", cmd->input, "Hex mesh: VTU, VTK, MEDIT, Gmsh, Abaqus, MFEM or Exodus")
      ->required();
  sub->add_option("surface", cmd->surface,
                  "Surface that it stands for, to be drawn over it: OBJ, OFF, STL, PLY, VTP, VTK, "
                  "Gmsh, Nastran or 3MF");
  sub->add_option("-o,--output", cmd->output, "Page: .html [a new folder for temporary files]");
  sub->add_flag("--no-open", cmd->no_open, "Write the page only");
  sub->add_option("--whole-up-to", cmd->max_whole_hexes,
                  "Of a mesh of more hexes the page holds the skin, slices and the worst 10,000")
      ->check(CLI::Range(1, 2'000'000'000))
      ->capture_default_str();
  add_console_options(*sub, program);
  sub->footer(
      "The page needs no network and holds all it shows: it can be sent and kept.\n"
      "Examples:\n"
      "  hexwright view part.vtu\n"
      "  hexwright view part.vtu part.stl -o part.html --no-open");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
