// hexwright picture: a mesh as PNG, one view or a sheet of several.
#include <filesystem>
#include <memory>
#include <optional>

#include "hexwright/io/mesh_io.h"
#include "hexwright/render/picture_sheet.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace hexwright::cli {
namespace {

struct PictureCommand {
  std::string input, output, cut = "auto";
  std::optional<double> cut_at;
  bool as_sheet = false, by_patch = false;
  int width = 0, height = 0;  ///< 0 = of the kind of picture
};

/// `none` keeps the direction of the automatic view, so that pictures with and without cut compare.
/// Patches lie outside: they are cut only when that is asked for.
PictureOptions choose_view(const PictureCommand& cmd, const HexMesh& mesh) {
  PictureOptions options;
  if (cmd.cut == "none" || (cmd.cut == "auto" && cmd.by_patch && !cmd.cut_at)) {
    options = make_default_view(mesh);
    options.cut.reset();
  } else if (cmd.cut == "auto") {
    options = make_default_view(mesh);
    if (cmd.cut_at) options.cut->offset = *cmd.cut_at;
  } else {
    const int axis = cmd.cut[0] - 'x';
    options = make_cut_view(axis, cmd.cut_at ? *cmd.cut_at : find_clear_cut(mesh, axis));
  }
  if (cmd.by_patch) options.colors = PictureColors::Patches;
  return options;
}

Image draw(const PictureCommand& cmd, const HexMesh& mesh) {
  if (cmd.as_sheet) {
    SheetOptions sheet;
    sheet.title = std::filesystem::path(cmd.input).filename().string();
    if (cmd.width > 0) sheet.width = cmd.width;
    if (cmd.height > 0) sheet.height = cmd.height;
    return render_sheet(mesh, sheet);
  }
  PictureOptions view = choose_view(cmd, mesh);
  if (cmd.width > 0) view.width = cmd.width;
  if (cmd.height > 0) view.height = cmd.height;
  return render_hex_mesh(mesh, view);
}

void run(const PictureCommand& cmd, Program& program) {
  check_outputs({cmd.output});
  require_extension(cmd.output, {".png"});
  write_png(cmd.output, draw(cmd, read_hex_mesh(cmd.input)));
  program.console.print(cmd.output);
}

}  // namespace

void add_picture_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<PictureCommand>();
  CLI::App* sub = app.add_subcommand("picture", "Draw a hex mesh as PNG");
  sub->add_option("input", cmd->input, "Hex mesh: VTU, VTK, MEDIT, Gmsh, Abaqus, MFEM or Exodus")
      ->required();
  sub->add_option("-o,--output", cmd->output, "Picture: .png")->required();
  sub->add_option("--cut", cmd->cut,
                  "Axis across which the mesh is cut open; auto: none with --by-patch")
      ->check(CLI::IsMember({"auto", "x", "y", "z", "none"}))
      ->capture_default_str();
  sub->add_option(
         "--cut-at", cmd->cut_at,
         "Place of the cut between the box's ends [near the middle, clear of faces along it]")
      ->check(CLI::Range(0.0, 1.0));
  sub->add_flag("--by-patch", cmd->by_patch, "Colours and names of patches instead of quality");
  sub->add_flag("--sheet", cmd->as_sheet,
                "Several views in one picture: outside, three cuts, worst hex, patches")
      ->excludes("--cut")
      ->excludes("--cut-at")
      ->excludes("--by-patch");
  sub->add_option("--width", cmd->width, "Pixels [1200, of a sheet 1800]")
      ->check(CLI::Range(16, 16384));
  sub->add_option("--height", cmd->height, "Pixels [900, of a sheet 1160]")
      ->check(CLI::Range(16, 16384));
  add_console_options(*sub, program);
  sub->footer(
      "Examples:\n"
      "  hexwright picture part.vtu -o part.png --cut x\n"
      "  hexwright picture part.vtu -o sheet.png --sheet");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
