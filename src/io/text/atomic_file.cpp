// Output files that appear whole or not at all.
//
// Written beside the target under a name of its own, then renamed over it, which POSIX makes atomic
// within a file system. A run that is stopped leaves the old file, or none, and never half of one.
#include "hexwright/io/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

#include "io/text/part_folder.h"

namespace hexwright {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& path, const std::string& reason,
                   ErrorCode code = ErrorCode::CannotOpen) {
  return Error(code,
               "cannot write the file: " + reason +
                   "; check that the folder exists, is writable and has space left",
               path.string());
}

/// What stopped a write that had begun is a lack of resources, not a wrong name.
Error cannot_finish(const fs::path& path, int reason) {
  return cannot_write(path, std::strerror(reason), ErrorCode::OutOfResources);
}

/// 0, or the errno of what failed.
int sync(std::FILE* file) {
  // File systems that cannot sync (EINVAL) write in order or not at all.
  return fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
}

/// Writes by pieces, each synced where wanted: neither can be interrupted, and a disk takes many
/// seconds for a large file. 0, or the errno of what failed. Ends with Error{Cancelled} between
/// pieces.
int write_all(std::FILE* file, std::string_view content, bool is_synced) {
  constexpr std::size_t kPiece = std::size_t{1} << 24;
  do {
    check_cancelled();
    const std::string_view piece = content.substr(0, kPiece);
    content.remove_prefix(piece.size());
    if (std::fwrite(piece.data(), 1, piece.size(), file) != piece.size()) return errno;
    if (std::fflush(file) != 0) return errno;
    if (const int reason = is_synced ? sync(file) : 0) return reason;
  } while (!content.empty());
  return 0;
}

/// The file written aside now, and the folder it is in where that is made too, for
/// remove_part_file().
std::atomic<const char*> part_path{nullptr};
std::atomic<const io::PartFolder*> part_folder{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free, "read in a signal handler");

/// A file beside `target` that nobody else has. It stays locked while it is open: those of other
/// runs that can be locked were left by runs that were killed.
class PartFile {
 public:
  explicit PartFile(const fs::path& target) : target_(target) {
    constexpr int kMostAttempts = 1000;
    while (attempt_ < kMostAttempts && !create(attempt_)) {
      if (errno != EEXIST) throw cannot_write(target, std::strerror(errno));
      if (!remove_if_left(name(attempt_))) ++attempt_;
    }
    if (!file_) throw cannot_write(target, "too many unfinished files are beside it");
  }
  ~PartFile() {
    part_path = nullptr;
    if (!is_renamed_) std::remove(path_.c_str());
    std::fclose(file_);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Removes what killed runs left under later numbers.
  void remove_left_behind() {
    for (int attempt = attempt_ + 1; remove_if_left(name(attempt)); ++attempt) {
    }
  }

  /// Writes, syncs and renames; 0, or the errno of what failed.
  int finish(std::string_view content) {
    if (const int reason = write_all(file_, content, true)) return reason;
    if (std::rename(path_.c_str(), target_.c_str()) != 0) return errno;
    is_renamed_ = true;
    return 0;
  }

 private:
  /// Cut so that it is legal wherever the target's is; names that agree so far take other numbers.
  std::string name(int attempt) const {
    constexpr std::size_t kMostBytes = 240;
    std::string name = ".";
    name.append(target_.filename().string(), 0, kMostBytes).append(".");
    name.append(std::to_string(attempt)).append(".part");
    return (target_.parent_path() / name).string();
  }

  bool create(int attempt) {
    path_ = name(attempt);
    file_ = std::fopen(path_.c_str(), "wbx");
    if (!file_) return false;
    part_path = path_.c_str();
    struct stat status = {};
    flock(fileno(file_), LOCK_EX | LOCK_NB);
    if (fstat(fileno(file_), &status) == 0 && status.st_nlink > 0) return true;
    part_path = nullptr;  // another run took it for a left one before it was locked
    std::fclose(file_);
    file_ = nullptr;
    errno = EEXIST;
    return false;
  }

  static bool remove_if_left(const std::string& path) {
    const int file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return false;
    const bool is_left = flock(file, LOCK_EX | LOCK_NB) == 0 && unlink(path.c_str()) == 0;
    close(file);
    return is_left;
  }

  fs::path target_;
  std::string path_;
  std::FILE* file_ = nullptr;
  int attempt_ = 0;  ///< the number in its name
  bool is_renamed_ = false;
};

void write_to_device(const fs::path& path, std::string_view content) {
  std::FILE* device = std::fopen(path.string().c_str(), "wb");  // /dev/null, a pipe
  if (!device) throw cannot_write(path, std::strerror(errno));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> guard(device, &std::fclose);
  const int reason = write_all(device, content, false);
  if (reason != 0) throw cannot_finish(path, reason);
}

}  // namespace

void remove_part_file() noexcept {
  if (const char* path = part_path.load()) unlink(path);
  const io::PartFolder* folder = part_folder.load();
  if (!folder) return;
  for (const std::string& file : folder->files) unlink(file.c_str());
  rmdir(folder->path.c_str());
}

void io::watch_part_folder(const PartFolder* folder) noexcept { part_folder = folder; }

/// Symbolic links are followed, so that the link stays a link. Devices and pipes cannot be replaced
/// and are written to directly.
void write_file_atomically(const fs::path& path, std::string_view content) {
  std::error_code ignored;
  const bool is_link = fs::is_symlink(path, ignored);
  if (is_link && !fs::exists(path, ignored))
    throw cannot_write(path, "it is a link to a file that does not exist");
  const fs::path resolved = is_link ? fs::weakly_canonical(path, ignored) : path;
  const fs::path& target = resolved.empty() ? path : resolved;
  if (fs::is_directory(target, ignored)) throw cannot_write(path, "it is a folder");
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
    return write_to_device(target, content);
  PartFile part(target);
  part.remove_left_behind();
  if (const int reason = part.finish(content)) throw cannot_finish(path, reason);
}

}  // namespace hexwright
