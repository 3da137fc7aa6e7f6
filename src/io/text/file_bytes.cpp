// Reads whole files.
#include "io/text/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <zlib.h>

#include "hexwright/base/cancel.h"

namespace hexwright::io {
namespace {

/// No surface or mesh that fits into memory is larger.
constexpr std::size_t kMostInflated = std::size_t{1} << 36;
/// What is read between two looks at the caller's flag.
constexpr std::size_t kPiece = std::size_t{1} << 24;

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b\x08"); }

/// All members of a gzip file, one after the other.
std::string inflate_gzip(const std::string& packed, const std::string& name) {
  const auto fail = [&](const char* what) {
    return bad_file(name, std::string("the compressed file ") + what + "; pack it again");
  };
  z_stream stream{};
  constexpr int kGzipOnly = 15 + 16;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);
  std::string out;
  std::string buffer(std::size_t{1} << 18, '\0');
  std::size_t begin = 0;
  int status = Z_OK;
  while (begin < packed.size() || status == Z_OK) {
    check_cancelled();
    if (status == Z_STREAM_END && !is_gzip(std::string_view(packed).substr(begin))) break;
    if (status == Z_STREAM_END && inflateReset(&stream) != Z_OK) throw fail("is damaged");
    const std::size_t piece = std::min(packed.size() - begin, std::size_t{1} << 30);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + begin));
    stream.avail_in = static_cast<uInt>(piece);
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_BUF_ERROR) throw fail("ends early");
    if (status != Z_OK && status != Z_STREAM_END) throw fail("is damaged");
    begin += piece - stream.avail_in;
    out.append(buffer, 0, buffer.size() - stream.avail_out);
    if (out.size() > kMostInflated) throw fail("holds more than 64 GB");
  }
  return out;
}

/// Fills the bytes as far as the file goes; returns how far.
std::size_t read_pieces(std::FILE* file, std::string& bytes) {
  std::size_t got = 0;
  while (got < bytes.size()) {
    check_cancelled();
    const std::size_t wanted = std::min(kPiece, bytes.size() - got);
    const std::size_t piece = std::fread(bytes.data() + got, 1, wanted, file);
    got += piece;
    if (piece != wanted) break;
  }
  return got;
}

}  // namespace

FileBytes read_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto fail = [&](const std::string& message) {
    return Error(ErrorCode::CannotOpen, message, name);
  };
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw fail("there is no such file; check the path");
  if (!std::filesystem::is_regular_file(status))
    throw fail("this is not a regular file; give the path of a mesh file");

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw fail(std::string("cannot open the file: ") + std::strerror(errno));
  std::error_code size_error;
  const auto size = std::filesystem::file_size(path, size_error);
  if (size_error) throw fail("cannot find the file's size: " + size_error.message());
  FileBytes result{name, std::string(static_cast<std::size_t>(size), '\0')};
  const std::size_t got = read_pieces(file.get(), result.bytes);
  if (got != result.bytes.size())
    throw fail("the file could be read only in part (" + std::to_string(got) + " of " +
               std::to_string(result.bytes.size()) + " bytes); is another program writing it?");
  if (is_gzip(result.bytes)) {
    result.bytes = inflate_gzip(result.bytes, name);
    result.was_packed = true;
  }
  return result;
}

std::string inner_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gz" ? lower_extension(path.stem()) : extension;
}

/// ASCII only: extensions of known formats have no other letters, and locales must not matter.
std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

}  // namespace hexwright::io
