// What readers ask of a netCDF file: dimensions, variables and their attributes, by name.
//
// The classic formats (CDF-1, -2, -5) are read here; netCDF-4, which lies in an HDF5 file, by the
// netCDF library, an optional component (HEXWRIGHT_NETCDF).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexwright::io {

class NetcdfFile {
 public:
  virtual ~NetcdfFile() = default;

  /// Absent when the file has none of this name.
  virtual std::optional<std::size_t> dimension(const std::string& name) const = 0;
  /// Lengths of its dimensions; absent when the file has no such variable, or is a classic one and
  /// has it for records.
  virtual std::optional<std::vector<std::size_t>> shape(const std::string& variable) const = 0;
  /// All entries, the last dimension fastest. Throws Error{BadFile} naming the variable.
  virtual std::vector<double> numbers(const std::string& variable) const = 0;
  /// All bytes of a variable of letters. Throws Error{BadFile} naming the variable.
  virtual std::string letters(const std::string& variable) const = 0;
  /// "" when there is none, or none of letters.
  virtual std::string text_attribute(const std::string& variable,
                                     const std::string& name) const = 0;
};

bool is_netcdf_classic(std::string_view bytes);
bool is_hdf5(std::string_view bytes);

/// The bytes must outlive the file. Throws Error{BadFile} when they are damaged, or when they are
/// of netCDF-4 and the component is not there.
std::unique_ptr<NetcdfFile> open_netcdf(std::string_view bytes, const std::string& file_name);

/// Of a file of netCDF-4; says how to get the component where it is missing.
std::unique_ptr<NetcdfFile> open_netcdf4(std::string_view bytes, const std::string& file_name);

}  // namespace hexwright::io
