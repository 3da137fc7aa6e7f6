// Options that several subcommands share.
#pragma once

#include <string>

#include <CLI/App.hpp>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/fit/fit.h"
#include "hexwright/grid/complete.h"
#include "hexwright/grid/sizing.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_surface.h"

#include "commands.h"

namespace hexwright::cli {

/// --quiet and --threads.
void add_console_options(CLI::App& cmd, Program& program);

/// --sizing, --tolerance, --min-level, --max-level, --max-cells.
void add_sizing_options(CLI::App& cmd, SizingOptions& options);

/// --pairing, --balance.
void add_complete_options(CLI::App& cmd, CompleteOptions& options);

/// --placement.
void add_placement_option(CLI::App& cmd, TargetOptions& options);

/// --feature-angle.
void add_feature_options(CLI::App& cmd, FeatureOptions& options);

/// --features, a file of the user's own creases; load_features() reads it.
void add_feature_file_option(CLI::App& cmd, std::string& file);

/// Adds the creases of a feature file to the options; an empty name adds none.
void load_features(const std::string& file, const TriMesh& surface, FeatureOptions& options);

/// --side, --padding, --vertices.
void add_fit_options(CLI::App& cmd, FitOptions& options);

/// Accepts whole numbers from 1 up. CLI11's own checks compare as doubles and let counts that do
/// not fit saturate.
CLI::Validator whole_count();

/// A share of the diagonal: "0.5%" or "0.005". Throws CLI::ValidationError naming the option.
double parse_share(const std::string& option, const std::string& text);

/// Fails early, before hours of work, when an output's extension is not among `extensions`.
void require_extension(const std::string& path, const std::vector<std::string>& extensions);

bool has_extension(const std::string& path, const std::vector<std::string>& extensions);

/// Extensions of grid files.
const std::vector<std::string>& grid_extensions();

/// Reads a surface and prints the reader's warnings.
TriMesh load_surface(const std::string& path, Program& program);

/// Names the file in errors about its content that stages after reading it raise.
template <class Stage>
auto naming_file(const std::string& path, Stage&& stage) {
  try {
    return stage();
  } catch (const Error& e) {
    const std::string text = e.what();
    const bool is_about_input =
        e.code() == ErrorCode::BadGeometry || e.code() == ErrorCode::BadFile;
    if (!is_about_input || text.find(path) != std::string::npos) throw;
    throw Error(e.code(), text, path);
  }
}

}  // namespace hexwright::cli
