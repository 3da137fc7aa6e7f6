// What every worker of an evaluation must know, and how the driver tells it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "hexwright/pipeline/evaluate.h"

namespace hexwright::cli {

struct BenchOptions {
  EvaluateOptions evaluate = default_evaluate_options();
  bool no_pictures = false;
  int picture_width = 360;  ///< pixels; the height is 5/6 of it
};

/// --grid-max-level, --grid-max-cells, --tolerance, --max-level, --rounds, --max-hexes, --no-dual,
/// --no-mesh, --no-pictures, --picture-width.
void add_bench_options(CLI::App& cmd, BenchOptions& options);

/// The options as arguments that add_bench_options reads back.
std::vector<std::string> to_arguments(const BenchOptions& options);

/// What results depend on, as text: the version, the hash of the program's file (two builds of one
/// version may differ) and the options.
std::string fingerprint(const BenchOptions& options, const std::filesystem::path& program);

}  // namespace hexwright::cli
