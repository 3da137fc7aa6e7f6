// A folder beside the target is filled, then the two change places.
#include "io/text/folder_output.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hexwright/base/error.h"
#include "hexwright/io/atomic_file.h"

#include "io/text/part_folder.h"

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

int open_folder(const fs::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

[[noreturn]] void fail_to_write(const fs::path& path, int reason) {
  fail(path, "cannot write the folder: " + std::generic_category().message(reason) +
                 "; check that the folder around it exists, is writable and has space left");
}

/// A new folder beside the target. It stays locked while the object lives: those of other runs that
/// can be locked were left by runs that were killed.
class PartFolderLock {
 public:
  PartFolderLock(const fs::path& path, const std::vector<FolderFile>& files) {
    constexpr int kMostAttempts = 1000;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      folder_.path =
          path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), attempt);
      remove_if_left();
      std::error_code error;
      const bool is_made = fs::create_directory(folder_.path, error);
      if (error) fail_to_write(path, error.value());
      if (!is_made || !lock(path)) continue;
      watch(files);
      return;
    }
    fail(path, "too many unfinished folders are beside it; remove them");
  }
  ~PartFolderLock() {
    watch_part_folder(nullptr);
    std::error_code ignored;
    if (!is_kept_) fs::remove_all(folder_.path, ignored);
    close(opened_);
  }
  PartFolderLock(const PartFolderLock&) = delete;
  PartFolderLock& operator=(const PartFolderLock&) = delete;

  const std::string& path() const { return folder_.path; }

  /// The folder takes the target's place; one that is there comes to its own and is removed.
  void take_place(const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
      if (std::rename(folder_.path.c_str(), path.c_str()) != 0) fail_to_write(path, errno);
      is_kept_ = true;
      return;
    }
    const char* part = folder_.path.c_str();
    if (renameat2(AT_FDCWD, part, AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0) return;
    if (errno != EINVAL && errno != ENOSYS) fail_to_write(path, errno);
    take_place_by_steps(path);
  }

 private:
  void remove_if_left() const {
    const int left = open_folder(folder_.path);
    if (left < 0) return;
    std::error_code ignored;
    if (flock(left, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder_.path, ignored);
    close(left);
  }

  /// False when another run took it for a left one before it was locked. File systems without locks
  /// do without.
  bool lock(const fs::path& path) {
    opened_ = open_folder(folder_.path);
    if (opened_ < 0 && errno != ENOENT) {
      const int reason = errno;
      rmdir(folder_.path.c_str());
      fail_to_write(path, reason);
    }
    struct stat status = {};
    if (opened_ >= 0 && (flock(opened_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
        fstat(opened_, &status) == 0 && status.st_nlink > 0)
      return true;
    if (opened_ >= 0) close(opened_);
    opened_ = -1;
    return false;
  }

  /// For file systems that exchange no names: the old one steps aside first, and comes back when
  /// the new one cannot take its place. A program that ends meanwhile leaves both.
  void take_place_by_steps(const fs::path& path) {
    const std::string aside = folder_.path + ".old";
    std::error_code ignored;
    fs::remove_all(aside, ignored);  // of a run that was killed here
    watch_part_folder(nullptr);
    if (std::rename(path.c_str(), aside.c_str()) != 0) fail_to_write(path, errno);
    if (std::rename(folder_.path.c_str(), path.c_str()) != 0) {
      const int reason = errno;
      std::rename(aside.c_str(), path.c_str());
      fail_to_write(path, reason);
    }
    std::rename(aside.c_str(), folder_.path.c_str());
    watch_part_folder(&folder_);
  }

  void watch(const std::vector<FolderFile>& files) {
    for (const FolderFile& file : files)
      folder_.files.push_back((fs::path(folder_.path) / file.name).string());
    watch_part_folder(&folder_);
  }

  PartFolder folder_;
  int opened_ = -1;
  bool is_kept_ = false;
};

}  // namespace

void write_folder_atomically(const fs::path& given, const std::vector<FolderFile>& files) {
  const fs::path path = given.has_filename() ? given : given.parent_path();  // "polyMesh/"
  check_replaceable(path, files);
  PartFolderLock part(path, files);
  for (const FolderFile& file : files)
    write_file_atomically(fs::path(part.path()) / file.name, file.bytes);
  part.take_place(path);
}

}  // namespace hexwright::io
