// A folder beside the target is filled, then the two change places.
#include "io/text/folder_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/io/atomic_file.h"

namespace hexwright::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& message) {
  throw Error(ErrorCode::CannotOpen, message, path.string());
}

void check_replaceable(const fs::path& path, const std::vector<std::string>& replaceable) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  if (!fs::is_directory(path, ignored)) fail(path, "is a file; name a folder for this format");
  for (const auto& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(ignored) ||
        std::find(replaceable.begin(), replaceable.end(), name) == replaceable.end())
      fail(path, "the folder holds '" + name +
                     "', which is no file of the format; remove it or choose another folder");
  }
}

/// A new folder beside the target.
fs::path make_part_folder(const fs::path& path, const char* ending) {
  constexpr int kMostAttempts = 1000;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::string name = fmt::format(".{}.{}{}", path.filename().string(), attempt, ending);
    fs::path part = path.parent_path() / name;
    std::error_code error;
    if (fs::create_directory(part, error)) return part;
    if (error) fail(path, "cannot write the folder: " + error.message());
  }
  fail(path, "too many unfinished folders are beside it; remove them");
}

}  // namespace

void write_folder_atomically(const fs::path& given, const std::vector<FolderFile>& files,
                             const std::vector<std::string>& replaceable) {
  const fs::path path = given.has_filename() ? given : given.parent_path();  // "polyMesh/"
  check_replaceable(path, replaceable);
  const fs::path part = make_part_folder(path, ".part");
  std::error_code error, ignored;
  try {
    for (const FolderFile& file : files) write_file_atomically(part / file.name, file.bytes);
  } catch (...) {
    fs::remove_all(part, ignored);
    throw;
  }
  fs::path old;
  if (fs::exists(path, ignored)) {
    old = make_part_folder(path, ".old");
    fs::rename(path, old, error);  // over the empty folder
  }
  if (!error) fs::rename(part, path, error);
  if (error) {
    fs::remove_all(part, ignored);
    fail(path, "cannot write the folder: " + error.message());
  }
  if (!old.empty()) fs::remove_all(old, ignored);
}

}  // namespace hexwright::io
