// A folder that is being filled aside, for handlers of signals.
#pragma once

#include <string>
#include <vector>

namespace hexwright::io {

/// With the full names of all files that it gets.
struct PartFolder {
  std::string path;
  std::vector<std::string> files;
};

/// The folder that remove_part_file() removes too, until null is given.
void watch_part_folder(const PartFolder* folder) noexcept;

}  // namespace hexwright::io
