#include "bench/bench_options.h"

#include <CLI/Config.hpp>
#include <fmt/format.h>

#include "hexwright/version.h"

#include "bench/results.h"
#include "options.h"

namespace hexwright::cli {

void add_bench_options(CLI::App& cmd, BenchOptions& options) {
  SizingOptions& grid = options.evaluate.sizing;
  MeshOptions& mesh = options.evaluate.mesh;
  cmd.add_option("--grid-max-level", grid.max_level, "Input grids are no deeper")
      ->check(CLI::Range(1, kMaxGridLevel))
      ->capture_default_str();
  cmd.add_option("--grid-max-cells", grid.max_cells, "Input grids have no more cells")
      ->check(whole_count())
      ->capture_default_str();
  cmd.add_option_function<std::string>(
         "--tolerance",
         [&mesh](const std::string& text) {
           mesh.sizing.tolerance = parse_share("--tolerance", text);
         },
         "Distance goal of the final mesh, share of the diagonal [0.5%]")
      ->type_name("SHARE");
  cmd.add_option("--max-level", mesh.sizing.max_level, "Deepest cell of the final mesh's grid")
      ->check(CLI::Range(0, kMaxGridLevel))
      ->capture_default_str();
  cmd.add_option("--rounds", mesh.max_rounds, "Refinements of the final mesh")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  cmd.add_option("--max-hexes", mesh.max_hexes, "Budget of the final mesh")
      ->check(whole_count())
      ->capture_default_str();
  cmd.add_flag("--no-dual", options.no_dual, "Count cells only: no dual mesh of the grids");
  cmd.add_flag("--no-mesh", options.no_mesh, "Compare completions only: no final mesh");
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
  if (options.no_dual) arguments.emplace_back("--no-dual");
  if (options.no_mesh) arguments.emplace_back("--no-mesh");
  if (options.no_pictures) arguments.emplace_back("--no-pictures");
  return arguments;
}

std::string fingerprint(const BenchOptions& options, const std::filesystem::path& program) {
  EvaluateOptions evaluate = options.evaluate;
  evaluate.run_dual = !options.no_dual;
  evaluate.run_mesh = !options.no_mesh;
  return fmt::format("hexwright {} program {} {} pictures {}", HEXWRIGHT_VERSION,
                     file_hash(program), evaluate_options_to_json(evaluate),
                     options.no_pictures ? 0 : options.picture_width);
}

}  // namespace hexwright::cli
