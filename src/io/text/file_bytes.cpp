// Reads whole files.
#include "io/text/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace hexwright::io {

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
  const std::size_t got = std::fread(result.bytes.data(), 1, result.bytes.size(), file.get());
  if (got != result.bytes.size())
    throw fail("the file could be read only in part (" + std::to_string(got) + " of " +
               std::to_string(result.bytes.size()) + " bytes); is another program writing it?");
  return result;
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
