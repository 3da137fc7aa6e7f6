// Decodes and encodes the binary blocks of VTK's XML files.
//
// Based on: "VTK XML file formats" (VTK documentation). Uncompressed: size, data. Compressed:
// number of parts, size of a part, size of the last part (0 = whole), compressed sizes, parts. In
// base64 the header and the data are encoded one after the other, each with its own padding.
#include "io/text/encoded_stream.h"

#include <array>
#include <vector>

#include <zlib.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

namespace hexwright::io {
namespace {

constexpr std::array<std::int8_t, 256> make_base64_values() {
  std::array<std::int8_t, 256> values{};
  for (auto& value : values) value = -1;
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  return values;
}
constexpr auto kBase64Values = make_base64_values();

/// Hands out bytes in order, whatever the encoding.
class ByteStream {
 public:
  ByteStream(std::string_view encoded, bool is_base64, const std::string& where)
      : left_(encoded), is_base64_(is_base64), where_(where) {}

  [[noreturn]] void fail() const {
    throw Error(ErrorCode::BadFile,
                "the data block is truncated or damaged; export or download the file again",
                where_);
  }

  /// More bytes than this cannot follow.
  std::size_t most_bytes_left() const { return left_.size() + pending_.size(); }

  std::string read(std::size_t count) {
    if (count > most_bytes_left()) fail();
    if (!is_base64_) {
      std::string result(left_.substr(0, count));
      left_.remove_prefix(count);
      return result;
    }
    std::string result;
    result.reserve(count);
    result.swap(pending_);
    while (result.size() < count) decode_group(result);
    pending_ = result.substr(count);
    result.resize(count);
    return result;
  }

  /// In base64 the data after a header starts with a new group of four letters.
  void end_part() { pending_.clear(); }

 private:
  void decode_group(std::string& out) {
    check_cancelled_();
    std::uint32_t bits = 0;
    int num_letters = 0, num_padding = 0;
    while (num_letters + num_padding < 4) {
      if (left_.empty()) fail();
      const char c = left_.front();
      left_.remove_prefix(1);
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
      const int value = kBase64Values[static_cast<unsigned char>(c)];
      if (c == '=') {
        ++num_padding;
      } else if (value < 0 || num_padding > 0) {
        fail();
      } else {
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        ++num_letters;
      }
    }
    if (num_letters < 2) fail();
    bits <<= 6 * num_padding;
    for (int i = 0; i < 3 - num_padding; ++i)
      out.push_back(static_cast<char>(bits >> (16 - 8 * i) & 0xff));
  }

  std::string_view left_;
  std::string pending_;  // decoded, not yet handed out
  bool is_base64_;
  CancelCheck check_cancelled_;
  const std::string& where_;
};

/// Headers are read through the same stream as the data, for in base64 both may share a group of
/// letters. All sizes are checked against what is left before memory is taken for them.
class BlockDecoder {
 public:
  BlockDecoder(std::string_view encoded, const BlockFormat& format, const std::string& where)
      : stream_(encoded, format.is_base64, where), format_(format) {}

  std::string run() { return format_.is_compressed ? read_compressed() : read_plain(); }

 private:
  std::size_t read_size() {
    const std::string bytes = stream_.read(format_.has_wide_headers ? 8 : 4);
    return format_.has_wide_headers
               ? static_cast<std::size_t>(load<std::uint64_t>(bytes.data(), format_.order))
               : load<std::uint32_t>(bytes.data(), format_.order);
  }

  // Header and data are one base64 text or two, depending on the writer: a header of 4 bytes with
  // padding of its own is told by the padding itself, which the stream passes over.
  std::string read_plain() {
    const std::size_t size = read_size();
    return stream_.read(size);
  }

  std::string read_compressed() {
    const std::size_t num_parts = read_size();
    const std::size_t part_size = read_size();
    const std::size_t last_size = read_size();
    if (num_parts > stream_.most_bytes_left()) stream_.fail();
    std::vector<std::size_t> packed_sizes(num_parts);
    for (std::size_t& size : packed_sizes) size = read_size();
    stream_.end_part();
    std::string result;
    for (std::size_t i = 0; i < num_parts; ++i) {
      check_cancelled();
      const bool is_last_short = i + 1 == num_parts && last_size > 0;
      append_part(stream_.read(packed_sizes[i]), is_last_short ? last_size : part_size, result);
    }
    return result;
  }

  /// zlib's own checksum finds damage inside of a part; a part must have exactly the announced
  /// size.
  void append_part(const std::string& packed, std::size_t size, std::string& out) {
    constexpr std::size_t kBestRatio = 1100;  // zlib's limit is 1032 to 1
    if (size / kBestRatio > packed.size()) stream_.fail();
    const std::size_t begin = out.size();
    out.resize(begin + size);
    uLongf got = static_cast<uLongf>(size);
    const int status = uncompress(reinterpret_cast<Bytef*>(out.data() + begin), &got,
                                  reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
    if (status != Z_OK || got != size) stream_.fail();
  }

  ByteStream stream_;
  const BlockFormat& format_;
};

}  // namespace

std::string decode_block(std::string_view encoded, const BlockFormat& format,
                         const std::string& where) {
  return BlockDecoder(encoded, format, where).run();
}

/// Parts of a fixed size, compressed independently of each other: any number of threads makes the
/// same bytes.
std::string encode_compressed_block(std::string_view data) {
  constexpr std::size_t kPart = std::size_t{1} << 18;
  constexpr int kLevel = 1;  // higher levels are slower and save a twentieth
  const std::size_t num_parts = (data.size() + kPart - 1) / kPart;
  std::vector<std::string> parts(num_parts);
  parallel_for(
      num_parts,
      [&](std::size_t i) {
        const std::string_view part = data.substr(i * kPart, kPart);
        uLongf size = compressBound(static_cast<uLong>(part.size()));
        parts[i].resize(size);
        compress2(reinterpret_cast<Bytef*>(parts[i].data()), &size,
                  reinterpret_cast<const Bytef*>(part.data()), static_cast<uLong>(part.size()),
                  kLevel);  // cannot fail: the buffer is as large as it may need
        parts[i].resize(size);
      },
      1);
  std::string out;
  const auto put = [&](std::size_t value) {
    store(out, static_cast<std::uint64_t>(value), ByteOrder::Little);
  };
  put(num_parts);
  put(kPart);
  put(data.size() % kPart);
  for (const std::string& part : parts) put(part.size());
  for (const std::string& part : parts) out += part;
  return out;
}

}  // namespace hexwright::io
