// The directory stands at the end of the file.
#include "io/text/zip_archive.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#include <zlib.h>

#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"

namespace hexwright::io {
namespace {

constexpr std::uint32_t kLocalMark = 0x04034b50, kCentralMark = 0x02014b50, kEndMark = 0x06054b50;
constexpr std::uint32_t kWideEndMark = 0x06064b50, kWideLocatorMark = 0x07064b50;
constexpr std::size_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22;
constexpr std::size_t kWideEndSize = 56, kWideLocatorSize = 20;
/// Deflate packs no number of bytes into fewer than this part of it.
constexpr std::size_t kMostInflated = 1100;

std::size_t number16(std::string_view bytes, std::size_t at) {
  return load<std::uint16_t>(bytes.data() + at, ByteOrder::Little);
}
std::uint32_t number32(std::string_view bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::Little);
}

std::uint64_t number64(std::string_view bytes, std::size_t at) {
  return load<std::uint64_t>(bytes.data() + at, ByteOrder::Little);
}

/// Where the directory begins, and how many entries it has.
struct Directory {
  std::uint64_t begin = 0, count = 0;
};

/// Of an archive whose end stands at `end`; a longer form of it may stand before.
Directory find_directory(std::string_view bytes, std::size_t end) {
  if (end >= kWideLocatorSize && number32(bytes, end - kWideLocatorSize) == kWideLocatorMark) {
    const std::uint64_t at = number64(bytes, end - kWideLocatorSize + 8);
    if (at < end && end - at >= kWideEndSize && number32(bytes, at) == kWideEndMark)
      return {number64(bytes, at + 48), number64(bytes, at + 32)};
  }
  return {number32(bytes, end + 16), number16(bytes, end + 10)};
}

/// The value of 64 bits in an extra field that stands for one of 32 that is all ones; `taken`
/// counts those before it.
std::uint64_t widen(std::uint64_t value, std::string_view extra, std::size_t& taken) {
  constexpr std::uint64_t kInExtra = 0xffffffff;
  if (value != kInExtra) return value;
  for (std::size_t at = 0; extra.size() >= 4 && at <= extra.size() - 4;) {
    const std::size_t size = number16(extra, at + 2);
    const std::size_t wanted = at + 4 + 8 * taken;
    if (number16(extra, at) == 1 && 8 * taken + 8 <= size && wanted + 8 <= extra.size()) {
      ++taken;
      return number64(extra, wanted);
    }
    at += 4 + size;
  }
  return value;
}

/// Where the end of the directory stands; npos when there is none. A comment may follow it.
std::size_t find_end(std::string_view bytes) {
  constexpr std::size_t kLongestComment = 0xffff;
  if (bytes.size() < kEndSize) return std::string_view::npos;
  const std::size_t last = bytes.size() - kEndSize;
  const std::size_t first = last > kLongestComment ? last - kLongestComment : 0;
  for (std::size_t at = last + 1; at-- > first;)
    if (number32(bytes, at) == kEndMark) return at;
  return std::string_view::npos;
}

/// Exactly `size` bytes, or "" when the data does not give them.
std::string inflate_raw(std::string_view packed, std::size_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -15) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool is_whole = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_out == 0;
  return is_whole ? out : std::string();
}

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

ZipArchive::ZipArchive(std::string_view bytes, const std::string& file_name)
    : bytes_(bytes), file_name_(file_name) {
  const auto fail = [&](const char* what) {
    return bad_file(file_name, std::string("the ZIP archive ") + what +
                                   "; it is truncated or damaged, export it again");
  };
  const std::size_t end = find_end(bytes);
  if (end == std::string_view::npos) throw fail("has no directory");
  const Directory directory = find_directory(bytes, end);
  std::size_t at = directory.begin;
  for (std::uint64_t e = 0; e < directory.count; ++e) {
    if (at > end || end - at < kCentralSize || number32(bytes, at) != kCentralMark)
      throw fail("has a damaged directory");
    const std::size_t name_size = number16(bytes, at + 28);
    const std::size_t extra_size = number16(bytes, at + 30);
    const std::size_t next = at + kCentralSize + name_size + extra_size + number16(bytes, at + 32);
    if (next > end) throw fail("has a damaged directory");
    const std::string_view extra = bytes.substr(at + kCentralSize + name_size, extra_size);
    names_.emplace_back(bytes.substr(at + kCentralSize, name_size));
    Entry& entry = entries_[names_.back()];
    std::size_t taken = 0;
    entry.is_encrypted = (number16(bytes, at + 8) & 1) != 0;
    entry.method = number16(bytes, at + 10);
    entry.checksum = number32(bytes, at + 16);
    entry.size = widen(number32(bytes, at + 24), extra, taken);
    entry.packed_size = widen(number32(bytes, at + 20), extra, taken);
    entry.header = widen(number32(bytes, at + 42), extra, taken);
    at = next;
  }
}

std::string_view ZipArchive::packed_bytes(const Entry& entry, const std::string& where) const {
  const auto fail = [&] {
    return bad_element(file_name_, where, "it lies beyond the end of the file; export it again");
  };
  if (entry.header > bytes_.size() || bytes_.size() - entry.header < kLocalSize ||
      number32(bytes_, entry.header) != kLocalMark)
    throw fail();
  const std::size_t begin = entry.header + kLocalSize + number16(bytes_, entry.header + 26) +
                            number16(bytes_, entry.header + 28);
  if (begin > bytes_.size() || bytes_.size() - begin < entry.packed_size) throw fail();
  return bytes_.substr(begin, entry.packed_size);
}

std::string ZipArchive::read(const std::string& name) const {
  const auto found = entries_.find(name);
  const auto fail = [&](const std::string& what) {
    return bad_element(file_name_, "'" + name + "'", "it " + what + "; export the file again");
  };
  if (found == entries_.end()) throw fail("is missing in the archive");
  const Entry& entry = found->second;
  if (entry.is_encrypted) throw fail("is encrypted, and no password is asked for");
  const std::string_view packed = packed_bytes(entry, "'" + name + "'");
  constexpr std::size_t kStored = 0, kDeflated = 8;
  if (entry.method != kStored && entry.method != kDeflated)
    throw fail("is packed by a method other than deflate");
  constexpr std::uint64_t kMostSize = std::numeric_limits<uInt>::max();  // of zlib, at once
  if (entry.method == kDeflated && std::max(entry.size, entry.packed_size) > kMostSize)
    throw fail("has more than 4 GB, which is more than is unpacked");
  if (entry.size > packed.size() * kMostInflated + kMostInflated) throw fail("is damaged");
  const std::string bytes =
      entry.method == kStored ? std::string(packed) : inflate_raw(packed, entry.size);
  const auto checksum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  if (bytes.size() != entry.size || checksum != entry.checksum) throw fail("is damaged");
  return bytes;
}

}  // namespace hexwright::io
