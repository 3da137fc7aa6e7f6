// The hexwright program: subcommands, and how every outcome becomes an exit code.
#include <exception>
#include <new>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/version.h"

#include "commands.h"
#include "memory.h"

namespace hexwright::cli {
namespace {

/// Documented in docs/cli.md; scripts depend on them.
int exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadArgument:
      return BadUsage;
    case ErrorCode::CannotOpen:
    case ErrorCode::BadFile:
    case ErrorCode::BadGeometry:
      return BadInput;
    case ErrorCode::OutOfResources:
    case ErrorCode::Cancelled:
      return OutOfResources;
  }
  return BadInput;
}

void add_commands(CLI::App& app, Program& program) {
  app.set_version_flag("--version", std::string("hexwright ") + HEXWRIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 valid, 1 done but the mesh fails the gate, 2 bad usage, 3 bad input, 4 out of "
      "resources.\n'hexwright COMMAND --help' shows the options of a command, with examples.");
  add_mesh_command(app, program);
  add_grid_command(app, program);
  add_complete_command(app, program);
  add_dual_command(app, program);
  add_fit_command(app, program);
  add_improve_command(app, program);
  add_inspect_command(app, program);
  add_check_command(app, program);
  add_convert_command(app, program);
  add_picture_command(app, program);
  add_view_command(app, program);
  add_polycube_command(app, program);
  add_polycube_map_command(app, program);
  add_bench_command(app, program);
  add_bench_one_command(app, program);
}

/// No exception leaves: each becomes one line on stderr and an exit code.
int run(Program& program, int argc, char** argv) {
  program.executable = argv[0];
  CLI::App app("Adaptive all-hexahedral meshing", "hexwright");
  add_commands(app, program);
  app.failure_message([](const CLI::App*, const CLI::Error& e) {
    return "error: " + to_one_line(e.what()) + "; --help shows what can be given\n";
  });
  const CancelScope scope(interrupt_flag());
  try {
    app.parse(argc, argv);
    return program.exit_code;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? Valid : BadUsage;
  } catch (const Error& e) {
    program.console.fail(e.what());
    return exit_code_of(e.code());
  } catch (const std::bad_alloc&) {
    program.console.fail(describe_memory_shortage());
    return OutOfResources;
  } catch (const std::exception& e) {
    program.console.fail(std::string("unexpected: ") + e.what());
    return OutOfResources;
  }
}

}  // namespace
}  // namespace hexwright::cli

int main(int argc, char** argv) {
  hexwright::cli::hold_standard_streams();
  hexwright::cli::install_signal_handlers();
  hexwright::cli::Program program;
  const int exit_code = hexwright::cli::run(program, argc, argv);
  return program.console.finish_output() ? exit_code : hexwright::cli::OutOfResources;
}
