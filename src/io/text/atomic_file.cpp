// Output files that appear whole or not at all.
//
// Written beside the target under a name of its own, then renamed over it, which POSIX makes atomic
// within a file system. A run that is stopped leaves the old file, or none, and never half of one.
#include "hexwright/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& path, const std::string& reason) {
  return Error(ErrorCode::CannotOpen,
               "cannot write the file: " + reason +
                   "; check that the folder exists, is writable and has space left",
               path.string());
}

/// Writes and closes; false with errno set when anything fails.
bool write_and_close(std::FILE* file, std::string_view content) {
  const bool is_written = std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                          std::fflush(file) == 0;
  const int reason = errno;
  const bool is_closed = std::fclose(file) == 0;
  if (!is_written) errno = reason;
  return is_written && is_closed;
}

/// A new file beside `target` that nobody else has; empty path with errno set on failure.
std::FILE* create_beside(const fs::path& target, fs::path& created) {
  constexpr int kMostAttempts = 1000;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::string name = ".";
    name.append(target.filename().string()).append(".").append(std::to_string(attempt));
    created = target.parent_path() / name.append(".part");
    if (std::FILE* file = std::fopen(created.string().c_str(), "wbx")) return file;
    if (errno != EEXIST) break;
  }
  return nullptr;
}

}  // namespace

/// Symbolic links are followed, so that the link stays a link. Devices and pipes cannot be replaced
/// and are written to directly.
void write_file_atomically(const fs::path& path, std::string_view content) {
  std::error_code ignored;
  const fs::path resolved =
      fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
  const fs::path& target = resolved.empty() ? path : resolved;
  if (fs::is_directory(target, ignored)) throw cannot_write(path, "it is a folder");
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    std::FILE* device = std::fopen(target.string().c_str(), "wb");  // /dev/null, a pipe
    if (!device || !write_and_close(device, content))
      throw cannot_write(path, std::strerror(errno));
    return;
  }
  fs::path aside;
  std::FILE* file = create_beside(target, aside);
  if (!file) throw cannot_write(path, std::strerror(errno));
  if (!write_and_close(file, content)) {
    const std::string reason = std::strerror(errno);
    fs::remove(aside, ignored);
    throw cannot_write(path, reason);
  }
  std::error_code error;
  fs::rename(aside, target, error);
  if (error) {
    fs::remove(aside, ignored);
    throw cannot_write(path, error.message());
  }
}

}  // namespace hexwright
