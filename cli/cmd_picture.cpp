// hexwright picture: a mesh as PNG, cut open and coloured by scaled Jacobian.
#include <map>
#include <memory>

#include "hexwright/io/mesh_io.h"

#include "commands.h"
#include "options.h"
#include "output.h"
#include "picture_file.h"

namespace hexwright::cli {
namespace {

struct PictureCommand {
  std::string input, output, cut = "auto";
  double cut_at = 0.5;
  int width = 1200, height = 900;
};

/// `none` keeps the direction of the automatic view, so that pictures with and without cut compare.
void run(const PictureCommand& cmd, Program& program) {
  check_outputs({cmd.output});
  require_extension(cmd.output, {".png"});
  const HexMesh mesh = read_hex_mesh(cmd.input);
  PictureOptions options;
  if (cmd.cut == "none") {
    options = make_default_view(mesh);
    options.cut.reset();
  } else if (cmd.cut == "auto") {
    options = make_default_view(mesh);
    options.cut->offset = cmd.cut_at;
  } else {
    options = make_cut_view(cmd.cut[0] - 'x', cmd.cut_at);
  }
  options.width = cmd.width;
  options.height = cmd.height;
  write_picture(cmd.output, mesh, options);
  program.console.print(cmd.output);
}

}  // namespace

void add_picture_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<PictureCommand>();
  CLI::App* sub = app.add_subcommand("picture", "Draw a hex mesh as PNG");
  sub->add_option("input", cmd->input, "Hex mesh: MEDIT, VTK or VTU")->required();
  sub->add_option("-o,--output", cmd->output, "Picture: .png")->required();
  sub->add_option("--cut", cmd->cut, "Axis across which the mesh is cut open")
      ->check(CLI::IsMember({"auto", "x", "y", "z", "none"}))
      ->capture_default_str();
  sub->add_option("--cut-at", cmd->cut_at, "Place of the cut between the box's ends")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  sub->add_option("--width", cmd->width, "Pixels")->check(CLI::Range(16, 16384));
  sub->add_option("--height", cmd->height, "Pixels")->check(CLI::Range(16, 16384));
  add_console_options(*sub, program);
  sub->footer("Example:\n  hexwright picture part.vtu -o part.png --cut x");
  sub->callback([cmd, &program] { run(*cmd, program); });
}

}  // namespace hexwright::cli
