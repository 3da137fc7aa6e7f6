// Binary blocks of VTK's XML files.
#include "io/text/encoded_stream.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

namespace hexwright::io {
namespace {

std::string encode_base64(const std::string& bytes) {
  static const char* kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string pseudo_random(std::size_t size) {
  std::string bytes(size, '\0');
  std::uint32_t state = 1;
  for (char& c : bytes) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 28);
  return bytes;
}

BlockFormat compressed_format() {
  BlockFormat format;
  format.has_wide_headers = true;
  format.is_compressed = true;
  return format;
}

TEST(EncodedStream, CompressedBlocksComeBack) {
  for (std::size_t size : {0u, 1u, 262143u, 262144u, 262145u, 700000u}) {
    const std::string data = pseudo_random(size);
    const std::string block = encode_compressed_block(data);
    EXPECT_EQ(decode_block(block + "tail", compressed_format(), "x"), data) << size;
  }
}

TEST(EncodedStream, BytesDoNotDependOnTheNumberOfThreads) {
  const std::string data = pseudo_random(900000);
  const ThreadLimit one(1);
  const std::string alone = encode_compressed_block(data);
  const ThreadLimit three(3);
  EXPECT_EQ(encode_compressed_block(data), alone);
}

TEST(EncodedStream, Base64WorksWithOneOrTwoPaddings) {
  BlockFormat format;
  format.is_base64 = true;
  for (std::uint32_t size = 0; size < 20; ++size) {
    const std::string data = pseudo_random(size);
    std::string header;
    store(header, size, ByteOrder::Little);
    EXPECT_EQ(decode_block("\n " + encode_base64(header + data) + "\n", format, "x"), data);
    EXPECT_EQ(decode_block(encode_base64(header) + encode_base64(data), format, "x"), data);
  }
}

TEST(EncodedStream, DamagedBlocksAreRefused) {
  const std::string block = encode_compressed_block(pseudo_random(5000));
  for (std::size_t size = 0; size < block.size(); size += 7)
    EXPECT_THROW(decode_block(block.substr(0, size), compressed_format(), "x"), Error) << size;
  std::string huge;  // one part that claims to grow to an exabyte
  for (std::uint64_t value :
       {std::uint64_t{1}, std::uint64_t{1} << 60, std::uint64_t{0}, std::uint64_t{3}})
    store(huge, value, ByteOrder::Little);
  EXPECT_THROW(decode_block(huge + "abc", compressed_format(), "x"), Error);
  BlockFormat base64;
  base64.is_base64 = true;
  EXPECT_THROW(decode_block("AAAA*AAA", base64, "x"), Error);
  EXPECT_THROW(decode_block("=AAA", base64, "x"), Error);
}

}  // namespace
}  // namespace hexwright::io
