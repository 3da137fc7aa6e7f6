// Tokens, lines and numbers of text, against plain splitting; and numbers written and read again.
#include "io/text/text_scanner.h"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "io/text/encoded_stream.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

using Tokens = std::vector<std::pair<std::size_t, std::string>>;  // line, word

/// Random words, blanks, line ends, comments and continued lines, with what must be found in them.
std::string random_text(std::mt19937_64& random, Tokens& expected) {
  std::string text;
  std::size_t line = 1;
  for (int i = 0; i < 60; ++i) {
    std::string word;
    for (std::size_t k = 1 + random() % 6; k > 0; --k) word += char('a' + random() % 26);
    expected.push_back({line, word});
    text += word;
    switch (random() % 8) {
      case 0:
        text += "\r\n";
        ++line;
        break;
      case 1:
        text += " # a comment with words\n";
        ++line;
        break;
      case 2:
        text += " \\\n\t";
        ++line;
        break;
      case 3:
        text += "\n\n \n";
        line += 3;
        break;
      default:
        text += random() % 2 ? " " : "\t\v";
    }
  }
  return text;
}

TEST(TextScanner, FindsEveryWordOnItsLine) {
  std::mt19937_64 random(61);
  for (int round = 0; round < 50; ++round) {
    Tokens expected, found;
    const std::string text = random_text(random, expected);
    TextScanner scanner(text, "a.txt");
    while (scanner.skip_blank()) {
      EXPECT_EQ(scanner.peek_token(), scanner.peek_token());
      const std::string peeked(scanner.peek_token());
      const std::size_t line = scanner.line();
      found.push_back({line, std::string(scanner.token())});
      EXPECT_EQ(found.back().second, peeked);
      EXPECT_EQ(scanner.where(), "a.txt:" + std::to_string(line));
    }
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(scanner.is_at_end());
    EXPECT_EQ(scanner.offset(), text.size());
    EXPECT_TRUE(scanner.token().empty());
  }
}

TEST(TextScanner, LineTokensStopAtTheLinesEnd) {
  TextScanner scanner("a b # c\nd \\\n e\nf", "x");
  EXPECT_EQ(scanner.line_token(), "a");
  EXPECT_EQ(scanner.line_token(), "b");
  EXPECT_EQ(scanner.line_token(), "");
  EXPECT_EQ(scanner.line_token(), "");
  scanner.next_line();
  EXPECT_EQ(scanner.line_token(), "d");
  EXPECT_EQ(scanner.line_token(), "e");  // the line goes on after the backslash
  EXPECT_EQ(scanner.line(), 3u);
  EXPECT_EQ(scanner.line_token(), "");
  scanner.next_line();
  EXPECT_EQ(scanner.rest_of_line(), "f");
  EXPECT_TRUE(scanner.is_at_end());
}

/// Any finite double, all exponents alike.
double random_double(std::mt19937_64& random) {
  while (true) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

TEST(TextWriter, NumbersComeBackToTheLastBit) {
  std::mt19937_64 random(62);
  for (int round = 0; round < 200; ++round) {
    TextWriter writer;
    std::vector<double> values;
    for (int i = 0; i < 50; ++i) {
      values.push_back(random_double(random));
      writer.real(values.back()).text(i % 7 == 0 ? "\n" : " ");
    }
    const std::string text = writer.take();
    TextScanner scanner(text, "x");
    for (double value : values)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(scanner.real("a number")),
                std::bit_cast<std::uint64_t>(value));
  }
}

TEST(TextWriter, RoundedNumbersAreTheNearestWithTheirDigits) {
  std::mt19937_64 random(63);
  for (int digits : {3, 8, 12})
    for (int i = 0; i < 200; ++i) {
      const double value = std::ldexp(double(random() >> 11), int(random() % 200) - 150);
      TextWriter writer;
      const std::string text = writer.real_rounded(value, digits).take();
      const double back = TextScanner(text, "x").real("a number");
      EXPECT_LE(std::abs(back - value), 0.500001 * std::pow(10, -digits) * 10 * std::abs(value));
      EXPECT_EQ(text.find('.'), 1u);
    }
}

TEST(TextScanner, RefusesWhatIsNoNumberAndNamesIt) {
  const auto refused = [](const std::string& token, bool is_real) {
    const std::string text = "\n\n" + token;
    TextScanner scanner(text, "f");
    try {
      is_real ? static_cast<void>(scanner.real("a size"))
              : static_cast<void>(scanner.integer("a size"));
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "f:3");
      EXPECT_NE(std::string(error.what()).find("a size"), std::string::npos) << error.what();
      return true;
    }
    return false;
  };
  for (const char* token : {"", "x", "1x", "+", "-", "++1", "+-1", "0x10", "1,5", "1e", "e5", "1e+",
                            "inf", "-nan", "1e400", "-1e400", "1_000"})
    EXPECT_TRUE(refused(token, true)) << token;
  for (const char* token : {"", "1.0", "1e3", "9223372036854775808", "-9223372036854775809", "0x1"})
    EXPECT_TRUE(refused(token, false)) << token;
  for (const char* token : {"0", "-0", "+7", "1e-400", "-1e-5000", "0.5", ".5", "5.", "1E5"})
    EXPECT_FALSE(refused(token, true)) << token;
  TextScanner scanner("-3", "f");
  EXPECT_THROW(scanner.count("a count"), Error);
}

TEST(TextScanner, MessagesShowOnlyPrintableParts) {
  EXPECT_EQ(in_quotes("abc"), "'abc'");
  EXPECT_EQ(in_quotes(std::string("a\x01\xff\n", 4)), "'a" + std::string(3, '?') + "'");
  const std::string quoted = in_quotes(std::string(1000, 'z'));
  EXPECT_LT(quoted.size(), 60u);
  EXPECT_TRUE(quoted.ends_with("...'"));
}

TEST(ByteReader, BothOrdersAreEachOthersReverse) {
  std::mt19937_64 random(64);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t value = random();
    std::string little, big;
    store(little, value, ByteOrder::Little);
    store(big, value, ByteOrder::Big);
    EXPECT_EQ(std::string(little.rbegin(), little.rend()), big);
    EXPECT_EQ(load<std::uint64_t>(little.data(), ByteOrder::Little), value);
    EXPECT_EQ(load<std::uint64_t>(big.data(), ByteOrder::Big), value);
    EXPECT_EQ(static_cast<unsigned char>(little[0]), value & 0xff);
  }
}

std::string base64_of(const std::string& bytes) {
  static const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kLetters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// The plain block of some data: its size in the format's header, then the data.
std::string plain_block(const std::string& data, const BlockFormat& format) {
  std::string block;
  if (format.has_wide_headers)
    store(block, std::uint64_t(data.size()), format.order);
  else
    store(block, std::uint32_t(data.size()), format.order);
  block += data;
  return format.is_base64 ? base64_of(block) : block;
}

// Every combination of order, header and encoding; cut at every byte nothing but the whole is
// taken.
TEST(EncodedStream, PlainBlocksOfEveryFormatComeBackWholeOrNotAtAll) {
  std::mt19937_64 random(65);
  for (int bits = 0; bits < 8; ++bits)
    for (std::size_t size : {0u, 1u, 2u, 3u, 50u}) {
      BlockFormat format;
      format.order = bits & 1 ? ByteOrder::Big : ByteOrder::Little;
      format.has_wide_headers = bits & 2;
      format.is_base64 = bits & 4;
      std::string data(size, '\0');
      for (char& c : data) c = static_cast<char>(random());
      const std::string block = plain_block(data, format);
      EXPECT_EQ(decode_block(block, format, "x"), data);
      for (std::size_t cut = 0; cut < block.size(); ++cut)
        EXPECT_THROW(decode_block(block.substr(0, cut), format, "x"), Error) << cut;
    }
}

// Damage inside zlib's stream is found by its checksum; damage in the headers never asks for more
// memory than the block could hold.
TEST(EncodedStream, ChangedBytesOfCompressedBlocksAreNoticed) {
  std::mt19937_64 random(66);
  std::string data(3000, '\0');
  for (char& c : data) c = static_cast<char>(2 * (random() % 100));
  const std::string block = encode_compressed_block(data);
  BlockFormat format;
  format.has_wide_headers = format.is_compressed = true;
  for (std::size_t at = 0; at < block.size(); ++at)
    for (int flip : {1, 16, 128}) {
      std::string changed = block;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      try {
        const std::string got = decode_block(changed, format, "x");
        // The size of whole parts means nothing when there is just a short one; a block of no parts
        // is no data, which readers compare with what they expect.
        EXPECT_TRUE(got == data || (got.empty() && at == 0)) << "byte " << at;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::BadFile);
        EXPECT_EQ(error.where(), "x");
      }
    }
}

}  // namespace
}  // namespace hexwright::io
