// HDF5 files without the library; other programs read them in foreign_sets_test.py.
#include "io/text/hdf5_writer.h"

#include <gtest/gtest.h>

#include "io/text/byte_reader.h"

namespace hexwright::io {
namespace {

// The first is the one that its author gives as an example.
TEST(Hdf5Writer, ChecksumIsLookup3) {
  EXPECT_EQ(hdf5_checksum("Four score and seven years ago"), 0x17770551u);
  EXPECT_EQ(hdf5_checksum(""), 0xdeadbeefu);
}

TEST(Hdf5Writer, TheSuperblockSaysWhereTheRootAndTheEndAre) {
  Hdf5Node root;
  const std::array<std::int32_t, 6> values = {1, 2, 3, 4, 5, 6};
  root.child("a").dataset("values", hdf5_ints(values, {2, 3}));
  const std::string file = root.file();
  ASSERT_TRUE(file.starts_with("\x89HDF\r\n\x1a\n"));
  EXPECT_EQ(load<std::uint64_t>(file.data() + 28, ByteOrder::Little), file.size());
  const auto place = load<std::uint64_t>(file.data() + 36, ByteOrder::Little);
  ASSERT_LT(place + 4, file.size());
  EXPECT_EQ(file.substr(place, 4), "OHDR");
  EXPECT_EQ(load<std::uint32_t>(file.data() + 44, ByteOrder::Little),
            hdf5_checksum(std::string_view(file).substr(0, 44)));
  std::string bytes;
  for (std::int32_t value : values) store(bytes, value, ByteOrder::Little);
  EXPECT_NE(file.find(bytes), std::string::npos);
}

TEST(Hdf5Writer, AChildIsMadeOnce) {
  Hdf5Node root;
  Hdf5Node& first = root.child("a");
  root.child("b");
  EXPECT_EQ(&root.child("a"), &first);
  EXPECT_EQ(root.file(), root.file());
}

TEST(Hdf5Writer, TextsAreCutAndFilledUp) {
  EXPECT_EQ(hdf5_text("abc", 5).data, std::string("abc\0\0", 5));
  EXPECT_EQ(hdf5_text("abcdef", 4).data, "abcd");
  const Hdf5Array rows = hdf5_text_rows({"a", "bc"}, 3);
  EXPECT_EQ(rows.data, std::string("a\0\0bc\0", 6));
  EXPECT_EQ(rows.lengths, std::vector<std::uint64_t>{2});
}

}  // namespace
}  // namespace hexwright::io
