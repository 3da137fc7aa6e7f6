// Files that appear whole or not at all.
#include "hexwright/io/atomic_file.h"

#include <atomic>

#include <gtest/gtest.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

#include "io/temp_folder.h"
#include "io/text/folder_output.h"
#include "io/text/part_folder.h"

namespace hexwright {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

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

TEST(AtomicFolder, TakesThePlaceOfTheOldOneAndOfWhatKilledRunsLeft) {
  const TempFolder folder;
  fs::create_directories(folder / ".case.0.part");
  folder.write(".case.0.part/points", "half");
  io::write_folder_atomically(folder / "case", {{"points", "1"}, {"faces", "2"}});
  io::write_folder_atomically(folder / "case", {{"points", "3"}, {"faces", "4"}});
  EXPECT_EQ(test::slurp(folder / "case/points"), "3");
  EXPECT_EQ(test::slurp(folder / "case/faces"), "4");
  EXPECT_EQ(folder.num_files(), 1u);
}

TEST(AtomicFolder, FailuresLeaveTheOldOneAndNothingElse) {
  const TempFolder folder;
  io::write_folder_atomically(folder / "case", {{"points", "1"}});
  const std::atomic<bool> is_cancelled = true;
  const CancelScope scope(&is_cancelled);
  EXPECT_THROW(io::write_folder_atomically(folder / "case", {{"points", "2"}}), Error);
  EXPECT_EQ(test::slurp(folder / "case/points"), "1");
  EXPECT_EQ(folder.num_files(), 1u);
}

// What a handler of signals calls before it ends the program.
TEST(AtomicFolder, IsRemovedByTheHandler) {
  const TempFolder folder;
  fs::create_directories(folder / ".case.0.part");
  folder.write(".case.0.part/points", "half");
  const io::PartFolder part{
      (folder / ".case.0.part").string(),
      {(folder / ".case.0.part/points").string(), (folder / ".case.0.part/faces").string()}};
  io::watch_part_folder(&part);
  remove_part_file();
  io::watch_part_folder(nullptr);
  EXPECT_EQ(folder.num_files(), 0u);
}

}  // namespace
}  // namespace hexwright
