// What the fuzz targets of readers share: the input as a file, and what may be thrown.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

#include "hexwright/base/error.h"

namespace hexwright::fuzz {

/// Writes the input where it costs no disk. Readers find formats by content first, so the extension
/// follows from the input's size: every one gets its turn.
template <std::size_t N>
std::string write_input(const std::uint8_t* data, std::size_t size,
                        const std::array<const char*, N>& extensions) {
  static const std::string kStem = "/dev/shm/hexwright_fuzz_" + std::to_string(getpid());
  const std::string path = kStem + extensions[size % N];
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0) std::abort();
  return path;
}

/// Stops the fuzzer at a fault of the program.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fault: %s\n", what);
  std::abort();
}

/// Reads the file and removes it. Errors of files are expected; they name the place. Anything else
/// that is thrown ends the fuzzer, and so does `read` by require().
template <class Read>
int read_input(const std::string& path, Read&& read) {
  try {
    read(path);
  } catch (const Error& error) {
    require(error.code() == ErrorCode::BadFile || error.code() == ErrorCode::CannotOpen,
            error.what());
    require(!error.where().empty(), "an error about a file names no place");
  }
  std::remove(path.c_str());
  return 0;
}

}  // namespace hexwright::fuzz
