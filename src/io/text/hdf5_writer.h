// Builds HDF5 files without the library: groups, whole arrays, attributes and soft links.
//
// Based on: The HDF Group, "HDF5 File Format Specification", version 3.0: superblock version 2,
// object headers version 2, links and attributes as messages in them, contiguous layout. HDF5 1.8
// and later read it. Differs from the library: no times are written, so that the bytes depend on
// the content alone.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hexwright::io {

/// The checksum of the format's metadata.
std::uint32_t hdf5_checksum(std::string_view bytes);

/// An array with its type and lengths (slowest first; none: a single value).
struct Hdf5Array {
  std::string type;  ///< datatype message
  std::vector<std::uint64_t> lengths;
  std::string data;
};

Hdf5Array hdf5_ints(std::span<const std::int32_t> values, std::vector<std::uint64_t> lengths);
Hdf5Array hdf5_longs(std::span<const std::int64_t> values, std::vector<std::uint64_t> lengths);
Hdf5Array hdf5_bytes(std::string_view values, bool is_signed);
Hdf5Array hdf5_doubles(std::span<const double> values, std::vector<std::uint64_t> lengths);
Hdf5Array hdf5_floats(std::span<const float> values);
/// One value each.
Hdf5Array hdf5_int(std::int32_t value);
Hdf5Array hdf5_double(double value);
/// A text of fixed length, filled up with zeros; `size` 0: as long as it is.
Hdf5Array hdf5_text(std::string_view text, std::size_t size = 0);
/// Texts as rows of so many 8-bit numbers.
Hdf5Array hdf5_text_rows(const std::vector<std::string>& texts, std::size_t size);

/// A group, or a dataset when it holds an array.
class Hdf5Node {
 public:
  /// The child of this name, made when it is not there. Children keep the order of their making.
  Hdf5Node& child(const std::string& name);
  /// A new child with an array.
  Hdf5Node& dataset(const std::string& name, Hdf5Array array);
  void attribute(const std::string& name, Hdf5Array array);
  /// To a path from the root.
  void soft_link(const std::string& name, const std::string& path);

  /// The file whose root group this is.
  std::string file() const;

 private:
  struct Link {
    std::string name;
    std::unique_ptr<Hdf5Node> node;  ///< null: a soft link
    std::string path;
  };
  std::uint64_t write(std::string& out) const;
  void add_links(std::string& messages, const std::vector<std::uint64_t>& places) const;

  std::vector<Link> links_;
  std::vector<std::pair<std::string, Hdf5Array>> attributes_;
  std::unique_ptr<Hdf5Array> array_;
};

}  // namespace hexwright::io
