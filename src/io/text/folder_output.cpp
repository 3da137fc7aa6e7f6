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

void check_replaceable(const fs::path& path, const std::vector<FolderFile>& files) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  if (!fs::is_directory(path, ignored)) fail(path, "is a file; name a folder for this format");
  for (const auto& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    const bool is_ours = std::any_of(files.begin(), files.end(),
                                     [&](const FolderFile& file) { return file.name == name; });
    if (!is_ours || entry.is_directory(ignored))
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

/// A folder that is there steps aside first, and comes back when the new one cannot take its place.
void take_place(const fs::path& part, const fs::path& path) {
  std::error_code error, ignored;
  if (!fs::exists(path, ignored)) {
    fs::rename(part, path, error);
    if (error) fail(path, "cannot write the folder: " + error.message());
    return;
  }
  const fs::path old = make_part_folder(path, ".old");
  fs::rename(path, old, error);  // over the empty folder
  if (!error) {
    fs::rename(part, path, error);
    if (error) fs::rename(old, path, ignored);
  }
  if (error) {
    fs::remove(old, ignored);  // empty, or back in its place
    fail(path, "cannot write the folder: " + error.message());
  }
  fs::remove_all(old, ignored);
}

}  // namespace

void write_folder_atomically(const fs::path& given, const std::vector<FolderFile>& files) {
  const fs::path path = given.has_filename() ? given : given.parent_path();  // "polyMesh/"
  check_replaceable(path, files);
  const fs::path part = make_part_folder(path, ".part");
  try {
    for (const FolderFile& file : files) write_file_atomically(part / file.name, file.bytes);
    take_place(part, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace hexwright::io
