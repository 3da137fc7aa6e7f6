// Writing results.
#include "output.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <unistd.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/render/picture.h"

namespace hexwright::cli {

namespace {

namespace fs = std::filesystem;

/// Whether two names lead to one file, which need not exist yet. Devices may serve twice.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored)) return false;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

void check_distinct(const std::vector<std::string>& outputs,
                    std::initializer_list<std::string> inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (is_same_file(outputs[i], outputs[k]))
        throw Error(ErrorCode::BadArgument,
                    "two outputs have this name; give each a file of its own", outputs[i]);
    for (const std::string& input : inputs)
      if (!input.empty() && is_same_file(outputs[i], input))
        throw Error(ErrorCode::BadArgument,
                    "the output would replace the input of this name; choose another", outputs[i]);
  }
}

}  // namespace

/// Races with other programs are not excluded; the writers report those when they come to it.
void check_outputs(std::initializer_list<std::string> outputs,
                   std::initializer_list<std::string> inputs) {
  std::vector<std::string> given;
  for (const std::string& path : outputs) {
    if (path.empty()) continue;
    given.push_back(path);
    std::error_code ignored;
    const bool is_mesh_folder = fs::path(path).filename() == "polyMesh";  // of OpenFOAM
    if (fs::is_directory(path, ignored) && !is_mesh_folder)
      throw Error(ErrorCode::CannotOpen, "is a folder; name a file in it", path);
    if (fs::is_symlink(path, ignored) && !fs::exists(path, ignored))
      throw Error(ErrorCode::CannotOpen, "is a link to a file that does not exist; remove it",
                  path);
    constexpr std::size_t kLongestName = 255;  // bytes; on every file system in use
    if (fs::path(path).filename().string().size() > kLongestName)
      throw Error(ErrorCode::CannotOpen, "the name is longer than 255 bytes; shorten it", path);
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
      throw Error(ErrorCode::CannotOpen,
                  "the folder " + folder.string() + " does not exist; create it first", path);
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
      throw Error(ErrorCode::CannotOpen, "the folder is not writable; choose another", path);
  }
  check_distinct(given, inputs);
}

std::vector<ChangedName> write_mesh_with_quality(const std::string& path, const HexMesh& mesh,
                                                 Console& console, const ElementChoice& choice,
                                                 const std::vector<HexField>& fields) {
  WriteHexOptions options;
  options.fields = fields;
  options.fields.push_back({"scaled_jacobian", compute_scaled_jacobians(mesh).raw()});
  options.format = choice.format;
  options.nodes_per_hex = choice.nodes_per_hex;
  options.names_by_place = true;
  return write_mesh(path, mesh, console, options);
}

std::vector<ChangedName> write_mesh(const std::string& path, const HexMesh& mesh, Console& console,
                                    const WriteHexOptions& options) {
  WriteHexResult result = write_hex_mesh(path, mesh, options);
  constexpr std::size_t kMostTold = 5;
  for (std::size_t k = 0; k < std::min(kMostTold, result.changed_names.size()); ++k) {
    const ChangedName& name = result.changed_names[k];
    console.warn(path + ": the set '" + name.given + "' is called '" + name.written +
                 "', because the format does not allow its name");
  }
  if (result.changed_names.size() > kMostTold)
    console.warn(path + ": " + std::to_string(result.changed_names.size() - kMostTold) +
                 " more sets have other names; --report lists them");
  return std::move(result.changed_names);
}

void write_cut_picture(const std::string& path, const HexMesh& mesh) {
  if (!path.empty()) write_png(path, render_hex_mesh(mesh, make_default_view(mesh)));
}

}  // namespace hexwright::cli
