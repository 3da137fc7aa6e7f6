// Builds netCDF files of the classic format with 64-bit offsets, without the library.
//
// Based on: Unidata, "The NetCDF Classic Format Specification" (CDF-2): a header of dimensions,
// attributes and variables, then the variables' data, all big-endian and padded to four bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hexwright::io {

class NetcdfWriter {
 public:
  /// Returns the dimension's number. Length 0 makes the unlimited dimension, of which there is one
  /// at most and which holds no records.
  std::int32_t dimension(const std::string& name, std::size_t length);

  void text_attribute(const std::string& name, const std::string& value);
  void int_attribute(const std::string& name, std::int32_t value);
  void float_attribute(const std::string& name, float value);

  /// A variable over dimensions; the data have as many entries as the dimensions say. `text` is one
  /// text attribute, left out when its name is empty.
  struct TextAttribute {
    std::string name, value;
  };
  void ints(const std::string& name, const std::vector<std::int32_t>& dimensions,
            std::span<const std::int32_t> data, const TextAttribute& text = {});
  void doubles(const std::string& name, const std::vector<std::int32_t>& dimensions,
               std::span<const double> data);
  /// One number per record, of which there are none. Must be the last variable.
  void record_doubles(const std::string& name, std::int32_t unlimited);
  /// Texts of one length each, filled up with zeros.
  void texts(const std::string& name, const std::vector<std::int32_t>& dimensions,
             const std::vector<std::string>& rows, std::size_t length);

  /// The file. Throws Error{OutOfResources} when a variable has more than 4 GB.
  std::string take();

 private:
  enum Type : std::int32_t { Char = 2, Int = 4, Float = 5, Double = 6 };
  struct Dimension {
    std::string name;
    std::size_t length;
  };
  struct Variable {
    std::string name;
    std::vector<std::int32_t> dimensions;
    TextAttribute attribute;
    Type type;
    std::string data;
    std::size_t size;  ///< bytes of the data, or of one record
  };

  void add(Variable&& variable);
  std::string header(const std::vector<std::uint64_t>& begins) const;

  std::vector<Dimension> dimensions_;
  std::string attributes_;
  std::int32_t num_attributes_ = 0;
  std::vector<Variable> variables_;
};

}  // namespace hexwright::io
