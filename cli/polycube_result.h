// What `polycube` and `polycube-map` write of a hex mesh made of a polycube map.
#pragma once

#include <string>

#include <CLI/App.hpp>

#include "hexwright/polycube/polycube.h"

#include "commands.h"

namespace hexwright::cli {

struct PolycubeOutputs {
  std::string mesh, report, picture, grid;
};

/// --report, --picture and --save-grid.
void add_polycube_outputs(CLI::App& cmd, PolycubeOutputs& outputs);

/// Before the work: extensions that cannot be written.
void check_polycube_outputs(const PolycubeOutputs& outputs);

/// Writes and prints everything, and sets the exit code. Warnings are about `input`.
void finish_polycube(const PolycubeOutputs& outputs, const std::string& input,
                     const PolycubeResult& result, Program& program);

}  // namespace hexwright::cli
