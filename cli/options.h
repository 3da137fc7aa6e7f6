// Options that several subcommands share.
#pragma once

#include <string>

#include <CLI/App.hpp>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/mesh_cad.h"
#include "hexwright/pipeline/option_table.h"

#include "commands.h"
#include "output.h"

namespace hexwright::cli {

/// --quiet and --threads.
void add_console_options(CLI::App& cmd, Program& program);

/// The rows of a table as options of a subcommand. What the rows refer to must outlive the run.
void add_options(CLI::App& cmd, const OptionTable& table);

/// --features, a file of the user's own creases; load_features() reads it.
void add_feature_file_option(CLI::App& cmd, std::string& file);

/// Adds the creases of a feature file to the options; an empty name adds none.
void load_features(const std::string& file, const TriMesh& surface, FeatureOptions& options);

/// A share of the diagonal: "0.5%" or "0.005". Throws CLI::ValidationError naming the option.
double read_share(const std::string& option, const std::string& text);

/// -o, a hex mesh.
void add_mesh_output_option(CLI::App& cmd, std::string& output);

/// --picture, for write_cut_picture().
void add_picture_option(CLI::App& cmd, std::string& picture);

/// Fails early, before hours of work, when an output's extension is not among `extensions`. An
/// empty path is an option that was not given.
void require_extension(const std::string& path, const std::vector<std::string>& extensions);

/// The same for hex meshes: the format by its name, or by the extension when the name is empty.
void require_mesh_format(const std::string& path, const ElementChoice& choice = {}, int order = 1);

/// --format and --nodes, of hex meshes.
void add_element_options(CLI::App& cmd, ElementChoice& choice);

/// --patch, rules that name parts of the surface.
void add_patch_option(CLI::App& cmd, std::vector<std::string>& rules);

/// Names parts of a surface as it was read by the rules of --patch; warns of rules that nothing
/// meets.
TriMesh name_patches(TriMesh&& surface, const std::vector<std::string>& rules, Program& program);

/// Reads a CAD file for a mesh with these options, and names its patches. Prints the warnings.
CadInput load_cad(const std::string& path, const std::vector<std::string>& rules,
                  const MeshOptions& options, Program& program);

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
