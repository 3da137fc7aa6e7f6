// Outputs that are folders: several files that appear together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hexwright::io {

/// A file of an output that is a folder.
struct FolderFile {
  std::string name, bytes;
};

/// Writes the files into a folder aside, which then takes the place of `path`. A folder that is
/// there is replaced when it holds nothing but files of the same names; else Error{CannotOpen}
/// names the first other one. Throws like write_file_atomically; what was there is there still
/// then.
void write_folder_atomically(const std::filesystem::path& path,
                             const std::vector<FolderFile>& files);

}  // namespace hexwright::io
