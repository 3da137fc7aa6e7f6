// Reads back what write_png wrote, with an own reader of the format's parts that it uses.
#include <zlib.h>

#include "hexwright/base/error.h"
#include "hexwright/render/picture.h"

#include "helpers.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

std::uint32_t read_u32(const std::string& s, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<std::uint8_t>(s[at + k]);
  return value;
}

// Contents of the chunks of a type; every checksum is compared.
std::string chunk_data(const std::string& png, const std::string& type) {
  std::string data;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = read_u32(png, at);
    const std::string body = png.substr(at + 4, size + 4);
    const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
    EXPECT_EQ(read_u32(png, at + 8 + size), crc32(0, bytes, static_cast<uInt>(body.size())));
    if (body.substr(0, 4) == type) data += body.substr(4);
    at += size + 12;
  }
  return data;
}

class PngTest : public ::testing::Test {
 protected:
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "image.png";
};

TEST_F(PngTest, HoldsTheImage) {
  Image image{5, 3, {}};
  for (int i = 0; i < 45; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 37));
  write_png(path_, image);
  const std::string png = test::slurp(path_);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const std::string header = chunk_data(png, "IHDR");
  EXPECT_EQ(read_u32(header, 0), 5u);
  EXPECT_EQ(read_u32(header, 4), 3u);
  EXPECT_EQ(header.substr(8), std::string({8, 2, 0, 0, 0}));
  const std::string packed = chunk_data(png, "IDAT");
  std::vector<std::uint8_t> rows(3 * 16);
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                       static_cast<uLong>(packed.size())),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t y = 0; y < 3; ++y) {
    ASSERT_EQ(rows[16 * y], 2);  // filter "up"
    for (std::size_t x = 0; x < 15; ++x) {
      if (y > 0) rows[16 * y + 1 + x] += rows[16 * (y - 1) + 1 + x];
      EXPECT_EQ(rows[16 * y + 1 + x], image.rgb[15 * y + x]);
    }
  }
}

TEST_F(PngTest, RejectsBytesThatDoNotMatchTheSize) {
  EXPECT_THROW(write_png(path_, Image{5, 3, {1, 2, 3}}), Error);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(PngTest, NamesAFolderThatDoesNotExist) {
  const Image image{1, 1, {1, 2, 3}};
  EXPECT_THROW(write_png("/no/such/folder/a.png", image), Error);
}

}  // namespace
}  // namespace hexwright
