// Output files that appear whole or not at all: written aside in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace hexwright {

/// Data reach the disk before the rename. What runs that were killed left beside the same target is
/// removed. Throws Error{CannotOpen} (folder missing, not writable, a link that leads nowhere) or
/// Error{OutOfResources} (disk full, file too large, reader gone), and then leaves nothing behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Removes the file that is being written aside, if any. For handlers of signals that end the
/// program; calls only what is allowed there.
void remove_part_file() noexcept;

}  // namespace hexwright
