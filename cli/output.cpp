// Writing results.
#include "output.h"

#include <filesystem>

#include <unistd.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/hex_quality.h"

namespace hexwright::cli {

void check_outputs(std::initializer_list<std::string> paths) {
  namespace fs = std::filesystem;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
      throw Error(ErrorCode::CannotOpen, "is a folder; name a file in it", path);
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
      throw Error(ErrorCode::CannotOpen,
                  "the folder " + folder.string() + " does not exist; create it first", path);
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
      throw Error(ErrorCode::CannotOpen, "the folder is not writable; choose another", path);
  }
}

void write_mesh_with_quality(const std::string& path, const HexMesh& mesh) {
  WriteHexOptions options;
  options.fields.push_back({"scaled_jacobian", compute_scaled_jacobians(mesh).raw()});
  write_hex_mesh(path, mesh, options);
}

}  // namespace hexwright::cli
