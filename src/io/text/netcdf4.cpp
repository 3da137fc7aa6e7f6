// Reads netCDF-4 files by the netCDF library, from memory.
#include <mutex>

#include <netcdf.h>
#include <netcdf_mem.h>

#include "io/text/file_bytes.h"
#include "io/text/netcdf_file.h"

namespace hexwright::io {
namespace {

/// Zlib packs no number of bytes into fewer than this part of it.
constexpr std::size_t kMostInflated = 1100;

/// The HDF5 library beneath is not for several threads at once.
std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

class LibraryFile : public NetcdfFile {
 public:
  LibraryFile(std::string_view bytes, const std::string& name)
      : most_entries_(bytes.size() * kMostInflated), name_(name) {
    const std::lock_guard lock(one_at_a_time());
    const int status = nc_open_mem(name.c_str(), NC_NOWRITE, bytes.size(),
                                   const_cast<char*>(bytes.data()), &file_);
    if (status != NC_NOERR)
      throw bad_file(name, std::string("this HDF5 file is no netCDF file, in which Exodus meshes "
                                       "lie, or is damaged (") +
                               nc_strerror(status) + "); export it again");
  }
  ~LibraryFile() override {
    const std::lock_guard lock(one_at_a_time());
    nc_close(file_);
  }
  LibraryFile(const LibraryFile&) = delete;
  LibraryFile& operator=(const LibraryFile&) = delete;

  std::optional<std::size_t> dimension(const std::string& name) const override {
    const std::lock_guard lock(one_at_a_time());
    int id = 0;
    std::size_t length = 0;
    if (nc_inq_dimid(file_, name.c_str(), &id) != NC_NOERR) return std::nullopt;
    if (nc_inq_dimlen(file_, id, &length) != NC_NOERR) return std::nullopt;
    return length;
  }

  std::optional<std::vector<std::size_t>> shape(const std::string& variable) const override {
    const std::lock_guard lock(one_at_a_time());
    int id = 0;
    if (nc_inq_varid(file_, variable.c_str(), &id) != NC_NOERR) return std::nullopt;
    return shape_of(id, variable);
  }

  std::vector<double> numbers(const std::string& variable) const override {
    const std::lock_guard lock(one_at_a_time());
    const int id = find(variable);
    std::vector<double> values(count_entries(id, variable));
    if (!values.empty() && nc_get_var_double(file_, id, values.data()) != NC_NOERR)
      throw bad_variable(variable, "cannot be read as numbers");
    return values;
  }

  std::string letters(const std::string& variable) const override {
    const std::lock_guard lock(one_at_a_time());
    const int id = find(variable);
    std::string text(count_entries(id, variable), '\0');
    if (!text.empty() && nc_get_var_text(file_, id, text.data()) != NC_NOERR)
      throw bad_variable(variable, "cannot be read as letters");
    return text;
  }

  std::string text_attribute(const std::string& variable, const std::string& name) const override {
    const std::lock_guard lock(one_at_a_time());
    const int id = find(variable);
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(file_, id, name.c_str(), &type, &length) != NC_NOERR) return {};
    if (type == NC_STRING && length == 1) return string_attribute(id, name);
    if (type != NC_CHAR || length > most_entries_) return {};
    std::string text(length, '\0');
    if (nc_get_att_text(file_, id, name.c_str(), text.data()) != NC_NOERR) return {};
    return text.substr(0, text.find('\0'));
  }

 private:
  Error bad_variable(const std::string& variable, const std::string& message) const {
    return bad_element(name_, "variable '" + variable + "'",
                       "it " + message + "; the file is damaged, export it again");
  }

  int find(const std::string& variable) const {
    int id = 0;
    if (nc_inq_varid(file_, variable.c_str(), &id) != NC_NOERR)
      throw bad_variable(variable, "is missing");
    return id;
  }

  std::vector<std::size_t> shape_of(int id, const std::string& variable) const {
    int rank = 0;
    if (nc_inq_varndims(file_, id, &rank) != NC_NOERR)
      throw bad_variable(variable, "has no dimensions");
    std::vector<int> dimensions(static_cast<std::size_t>(rank));
    std::vector<std::size_t> shape(dimensions.size());
    if (nc_inq_vardimid(file_, id, dimensions.data()) != NC_NOERR)
      throw bad_variable(variable, "has no dimensions");
    for (std::size_t d = 0; d < shape.size(); ++d)
      if (nc_inq_dimlen(file_, dimensions[d], &shape[d]) != NC_NOERR)
        throw bad_variable(variable, "has a dimension without length");
    return shape;
  }

  /// Memory stays within a constant factor of the file's size.
  std::size_t count_entries(int id, const std::string& variable) const {
    std::size_t count = 1;
    for (const std::size_t length : shape_of(id, variable)) {
      if (length != 0 && count > most_entries_ / length)
        throw bad_variable(variable, "has more entries than the file can hold");
      count *= length;
    }
    return count;
  }

  std::string string_attribute(int id, const std::string& name) const {
    char* text = nullptr;
    if (nc_get_att_string(file_, id, name.c_str(), &text) != NC_NOERR || !text) return {};
    std::string result = text;
    nc_free_string(1, &text);
    return result;
  }

  int file_ = 0;
  std::size_t most_entries_;
  const std::string& name_;
};

}  // namespace

std::unique_ptr<NetcdfFile> open_netcdf4(std::string_view bytes, const std::string& file_name) {
  return std::make_unique<LibraryFile>(bytes, file_name);
}

}  // namespace hexwright::io
