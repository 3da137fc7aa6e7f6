// The subcommands. Each adds itself to the program; its callback throws hexwright::Error and sets
// the exit code.
#pragma once

#include <CLI/App.hpp>

#include "console.h"

namespace hexwright::cli {

/// What the program ends with.
enum ExitCode : int {
  Valid = 0,           ///< done, and what was made or checked is valid
  FailsGate = 1,       ///< done, but the mesh fails the gate; the reason was printed
  BadUsage = 2,        ///< the command line is wrong
  BadInput = 3,        ///< an input cannot be read or meshed, an output not written
  OutOfResources = 4,  ///< a budget or the memory does not suffice, or the run was interrupted
};

/// What a subcommand leaves for main().
struct Program {
  Console console;
  int exit_code = Valid;
  std::string executable;  ///< as called
};

void add_mesh_command(CLI::App& app, Program& program);
void add_grid_command(CLI::App& app, Program& program);
void add_complete_command(CLI::App& app, Program& program);
void add_dual_command(CLI::App& app, Program& program);
void add_fit_command(CLI::App& app, Program& program);
void add_improve_command(CLI::App& app, Program& program);
void add_inspect_command(CLI::App& app, Program& program);
void add_check_command(CLI::App& app, Program& program);
void add_convert_command(CLI::App& app, Program& program);
void add_picture_command(CLI::App& app, Program& program);
void add_view_command(CLI::App& app, Program& program);
void add_bench_command(CLI::App& app, Program& program);
void add_bench_one_command(CLI::App& app, Program& program);
void add_polycube_command(CLI::App& app, Program& program);
void add_polycube_map_command(CLI::App& app, Program& program);

}  // namespace hexwright::cli
