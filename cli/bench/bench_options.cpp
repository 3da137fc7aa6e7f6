#include "bench/bench_options.h"

#include <CLI/Config.hpp>
#include <fmt/format.h>

#include "hexwright/version.h"

#include "bench/results.h"
#include "options.h"

namespace hexwright::cli {

void add_bench_options(CLI::App& cmd, BenchOptions& options) {
  add_options(cmd, make_option_table(options.evaluate));
  cmd.add_flag("--no-pictures", options.no_pictures,
               "Draw nothing, and make no pages to look into meshes with");
  cmd.add_option("--picture-width", options.picture_width, "Pixels of each picture in the report")
      ->check(CLI::Range(60, 4000))
      ->capture_default_str();
}

std::vector<std::string> to_arguments(const BenchOptions& options) {
  const SizingOptions& grid = options.evaluate.sizing;
  const MeshOptions& mesh = options.evaluate.mesh;
  std::vector<std::string> arguments = {"--grid-max-level", fmt::to_string(grid.max_level),
                                        "--grid-max-cells", fmt::to_string(grid.max_cells),
                                        "--tolerance",      fmt::to_string(mesh.sizing.tolerance),
                                        "--max-level",      fmt::to_string(mesh.sizing.max_level),
                                        "--rounds",         fmt::to_string(mesh.max_rounds),
                                        "--max-hexes",      fmt::to_string(mesh.max_hexes),
                                        "--picture-width",  fmt::to_string(options.picture_width)};
  if (!options.evaluate.run_dual) arguments.emplace_back("--no-dual");
  if (!options.evaluate.run_mesh) arguments.emplace_back("--no-mesh");
  if (options.no_pictures) arguments.emplace_back("--no-pictures");
  return arguments;
}

std::string fingerprint(const BenchOptions& options, const std::filesystem::path& program) {
  return fmt::format("hexwright {} program {} {} pictures {}", HEXWRIGHT_VERSION,
                     file_hash(program), evaluate_options_to_json(options.evaluate),
                     options.no_pictures ? 0 : options.picture_width);
}

}  // namespace hexwright::cli
