// A file's whole content, with the name that messages use for it.
#pragma once

#include <filesystem>
#include <string>

#include "hexwright/base/error.h"

namespace hexwright::io {

/// Largest number of vertices or elements that 32-bit ids allow.
inline constexpr std::size_t kMaxElements = 0x7ffffff0;

struct FileBytes {
  std::string name;         ///< as the caller gave it
  std::string bytes;        ///< the whole content, unpacked
  bool was_packed = false;  ///< by gzip
};

/// Unpacks what gzip packed, whatever the file is called. Throws Error{CannotOpen} when the file is
/// absent, is no regular file or cannot be read, and Error{BadFile} when what is packed is damaged.
FileBytes read_file(const std::filesystem::path& path);

/// The extension in lower case with its dot: ".stl".
std::string lower_extension(const std::filesystem::path& path);

/// The same of what is in the file: ".stl" of "part.stl.gz".
std::string inner_extension(const std::filesystem::path& path);

/// Error{BadFile} at an element of a file without lines: "part.stl: facet 12".
inline Error bad_element(const std::string& file, const std::string& element,
                         const std::string& message) {
  return Error(ErrorCode::BadFile, message, file + ": " + element);
}

/// Error{BadFile} about the file as a whole.
inline Error bad_file(const std::string& file, const std::string& message) {
  return Error(ErrorCode::BadFile, message, file);
}

}  // namespace hexwright::io
