// Files that appear whole or not at all.
#include "hexwright/io/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <functional>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

#include "io/temp_folder.h"
#include "io/text/folder_output.h"

namespace {

/// What the file system cannot do, and what happens once, when something whose name ends so is
/// about to be renamed.
struct FileSystem {
  bool has_exchange = true, has_locks = true;
  const char* renamed = "";
  std::function<void()> before_rename;
};
FileSystem file_system;

int change_name(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (file_system.before_rename && std::string_view(from).ends_with(file_system.renamed))
    std::exchange(file_system.before_rename, nullptr)();
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

}  // namespace

// In place of the C library's.
extern "C" int rename(const char* from, const char* to) noexcept {
  return change_name(AT_FDCWD, from, AT_FDCWD, to, 0);
}
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) noexcept {
  if (file_system.has_exchange) return change_name(from_folder, from, to_folder, to, flags);
  errno = EINVAL;
  return -1;
}
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"  // a struct has this name too
extern "C" int flock(int file, int operation) noexcept {
  if (file_system.has_locks) return static_cast<int>(syscall(SYS_flock, file, operation));
  errno = ENOLCK;
  return -1;
}
#pragma GCC diagnostic pop

namespace hexwright {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

/// The usual file system again at the end of a test.
struct AtomicFolder : testing::Test {
  void TearDown() override { file_system = {}; }
};

TEST(AtomicFile, ReplacesTheWholeContentAndLeavesNothingElse) {
  const TempFolder folder;
  write_file_atomically(folder / "a.txt", std::string(100000, 'x'));
  write_file_atomically(folder / "a.txt", std::string("a\0b", 3));
  EXPECT_EQ(test::slurp(folder / "a.txt"), std::string("a\0b", 3));
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFile, FailuresLeaveTheOldFileAndNothingElse) {
  const TempFolder folder;
  fs::create_directory(folder / "sub");
  for (const fs::path& path : {folder / "missing/a.txt", folder / "sub"}) {
    try {
      write_file_atomically(path, "x");
      ADD_FAILURE() << path << " was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::CannotOpen);
      EXPECT_EQ(error.where(), path.string());
    }
  }
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFile, FullDevicesAreReportedAndDevicesAreNotReplaced) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  EXPECT_THROW(write_file_atomically("/dev/full", "x"), Error);
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, SymbolicLinksKeepPointingAtTheFile) {
  const TempFolder folder;
  folder.write("real.txt", "old");
  fs::create_symlink("real.txt", folder / "link.txt");
  write_file_atomically(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(test::slurp(folder / "real.txt"), "new");
}

TEST(AtomicFile, ALinkThatLeadsNowhereIsSaidAndKept) {
  const TempFolder folder;
  fs::create_symlink("absent.txt", folder / "link.txt");
  EXPECT_THROW(write_file_atomically(folder / "link.txt", "new"), Error);
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFile, NamesAsLongAsFileSystemsAllowAreWritten) {
  const TempFolder folder;
  const std::string name(255, 'x');
  write_file_atomically(folder / name, "whole");
  EXPECT_EQ(test::slurp(folder / name), "whole");
}

TEST(AtomicFile, LeftoversOfKilledRunsAreRemoved) {
  const TempFolder folder;
  folder.write(".a.txt.0.part", "half");
  folder.write(".a.txt.1.part", "half");
  write_file_atomically(folder / "a.txt", "whole");
  EXPECT_EQ(test::slurp(folder / "a.txt"), "whole");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFile, ACancelledWriteLeavesTheOldFileAndNothingElse) {
  const TempFolder folder;
  folder.write("a.txt", "old");
  const std::atomic<bool> is_cancelled = true;
  const CancelScope scope(&is_cancelled);
  EXPECT_THROW(write_file_atomically(folder / "a.txt", "new"), Error);
  EXPECT_EQ(test::slurp(folder / "a.txt"), "old");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFile, LargeFilesAreWrittenWhole) {
  const TempFolder folder;
  std::string content((std::size_t{1} << 25) + 7, 'x');  // pieces, the last of them short
  content[1 << 24] = 'y';
  write_file_atomically(folder / "a.txt", content);
  EXPECT_TRUE(test::slurp(folder / "a.txt") == content);
}

TEST_F(AtomicFolder, TakesThePlaceOfTheOldOneAndOfWhatKilledRunsLeft) {
  const TempFolder folder;
  fs::create_directories(folder / ".case.0.part");
  folder.write(".case.0.part/points", "half");
  io::write_folder_atomically(folder / "case", {{"points", "1"}, {"faces", "2"}});
  io::write_folder_atomically(folder / "case", {{"points", "3"}, {"faces", "4"}});
  EXPECT_EQ(test::slurp(folder / "case/points"), "3");
  EXPECT_EQ(test::slurp(folder / "case/faces"), "4");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST_F(AtomicFolder, FailuresLeaveTheOldOneAndNothingElse) {
  const TempFolder folder;
  io::write_folder_atomically(folder / "case", {{"points", "1"}});
  const std::atomic<bool> is_cancelled = true;
  const CancelScope scope(&is_cancelled);
  EXPECT_THROW(io::write_folder_atomically(folder / "case", {{"points", "2"}}), Error);
  EXPECT_EQ(test::slurp(folder / "case/points"), "1");
  EXPECT_EQ(folder.num_files(), 1u);
}

// What a handler of signals calls before it ends the program.
TEST_F(AtomicFolder, IsRemovedByTheHandler) {
  const TempFolder folder;
  io::write_folder_atomically(folder / "case", {{"points", "1"}, {"faces", "2"}});
  std::size_t num_left = 0;
  file_system.renamed = "case.0.part";
  file_system.before_rename = [&] {
    remove_part_file();
    num_left = folder.num_files();
  };
  EXPECT_THROW(io::write_folder_atomically(folder / "case", {{"points", "3"}, {"faces", "4"}}),
               Error);
  EXPECT_EQ(num_left, 1u);
  EXPECT_EQ(test::slurp(folder / "case/points"), "1");
}

TEST_F(AtomicFolder, TakesItsPlaceWhereNamesCannotBeExchanged) {
  const TempFolder folder;
  file_system.has_exchange = false;
  fs::create_directories(folder / ".case.0.part.old");  // of a run that was killed
  folder.write(".case.0.part.old/points", "0");
  io::write_folder_atomically(folder / "case", {{"points", "1"}});
  // A signal between the two renames: the new folder is the only one that has a name.
  file_system.renamed = "case.0.part";
  file_system.before_rename = [] { remove_part_file(); };
  io::write_folder_atomically(folder / "case", {{"points", "2"}});
  EXPECT_EQ(test::slurp(folder / "case/points"), "2");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST_F(AtomicFolder, IsWrittenWhereNothingCanBeLocked) {
  const TempFolder folder;
  file_system.has_locks = false;
  io::write_folder_atomically(folder / "case", {{"points", "1"}});
  EXPECT_EQ(test::slurp(folder / "case/points"), "1");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST_F(AtomicFolder, TooManyOpenFilesAreSaidAndLeaveNothing) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers open files of their own";
#endif
  const TempFolder folder;
  rlimit usual = {};
  getrlimit(RLIMIT_NOFILE, &usual);
  const int next = open("/dev/null", O_RDONLY);
  close(next);
  const rlimit none = {static_cast<rlim_t>(next), usual.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  std::string said;
  try {
    io::write_folder_atomically(folder / "case", {{"points", "1"}});
  } catch (const Error& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_NE(said.find("cannot write the folder: Too many open files; check"), std::string::npos)
      << said;
  EXPECT_EQ(folder.num_files(), 0u);
}

}  // namespace
}  // namespace hexwright
