// Files in a ZIP archive, stored or deflated.
//
// Based on: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", version 6.3: end of central
// directory, central directory, local headers, also in their ZIP64
// forms. Differs: no encryption, one disk.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hexwright::io {

class ZipArchive {
 public:
  /// The bytes must outlive the archive. Throws Error{BadFile} for one that is truncated or
  /// damaged.
  ZipArchive(std::string_view bytes, const std::string& file_name);

  /// Names in the order of the directory.
  const std::vector<std::string>& names() const { return names_; }
  bool has(const std::string& name) const { return entries_.contains(name); }
  /// Unpacked, and checked by its checksum. Throws Error{BadFile} naming the entry.
  std::string read(const std::string& name) const;

 private:
  struct Entry {
    std::uint64_t method = 0, packed_size = 0, size = 0, header = 0, checksum = 0;
    bool is_encrypted = false;
  };
  std::string_view packed_bytes(const Entry& entry, const std::string& where) const;

  std::string_view bytes_;
  const std::string& file_name_;
  std::vector<std::string> names_;
  std::map<std::string, Entry> entries_;
};

bool is_zip(std::string_view bytes);

}  // namespace hexwright::io
