// Output files that appear whole or not at all: written aside in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace hexwright {

/// Throws Error{CannotOpen} (folder missing, not writable, disk full) and then leaves nothing
/// behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace hexwright
