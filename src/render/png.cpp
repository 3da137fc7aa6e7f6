// Based on: W3C, "Portable Network Graphics (PNG) Specification", third edition, sections 5, 9, 11.
//
// One IDAT chunk, filter 2 for every row: neighbouring rows of a picture are alike. The same bytes
// for the same image, as far as zlib's are.
#include <string>

#include <zlib.h>

#include "hexwright/base/error.h"
#include "hexwright/io/atomic_file.h"
#include "hexwright/render/picture.h"

namespace hexwright {
namespace {

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift & 0xff);
}

const Bytef* bytes_of(const std::string& text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

// Length, type, data, and the checksum of type and data.
void append_chunk(std::string& out, const char* type, const std::string& data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::string body = type + data;
  out += body;
  append_u32(out,
             static_cast<std::uint32_t>(crc32(0, bytes_of(body), static_cast<uInt>(body.size()))));
}

// Every row begins with its filter: 2, each byte minus the one above it.
std::string filter_rows(const Image& image) {
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  std::string rows;
  rows.reserve((stride + 1) * static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (i % stride == 0) rows += char{2};
    const int above = i < stride ? 0 : image.rgb[i - stride];
    rows += static_cast<char>(image.rgb[i] - above);
  }
  return rows;
}

std::string compress_bytes(const std::string& data) {
  uLongf size = compressBound(static_cast<uLong>(data.size()));
  std::string packed(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(data),
                               static_cast<uLong>(data.size()), 9);
  if (status != Z_OK) throw Error(ErrorCode::OutOfResources, "an image could not be compressed");
  packed.resize(size);
  return packed;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() !=
          3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw Error(ErrorCode::BadArgument, "an image's bytes do not match its width and height",
                path.string());
  std::string header;
  append_u32(header, static_cast<std::uint32_t>(image.width));
  append_u32(header, static_cast<std::uint32_t>(image.height));
  header += {8, 2, 0, 0, 0};  // 8 bits, RGB, deflate, filters per row, not interlaced
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", compress_bytes(filter_rows(image)));
  append_chunk(png, "IEND", {});
  write_file_atomically(path, png);
}

}  // namespace hexwright
