// Reads netCDF files of the classic formats, without the library.
//
// Based on: Unidata, "The NetCDF Classic Format Specification" (CDF-1, CDF-2, CDF-5).
// Differs: variables of records, which hold results over time, are passed over.
#include <functional>
#include <map>

#include "hexwright/base/cancel.h"

#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"
#include "io/text/netcdf_file.h"

namespace hexwright::io {
namespace {

enum Type : std::int32_t {
  Byte = 1,
  Char,
  Short,
  Int,
  Float,
  Double,
  UByte,
  UShort,
  UInt,
  Int64,
  UInt64
};
constexpr std::array<std::size_t, 12> kTypeSize = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
constexpr std::int32_t kDimensions = 0x0A, kVariables = 0x0B, kAttributes = 0x0C;

struct Variable {
  std::vector<std::size_t> shape;
  std::map<std::string, std::string> attributes;  // those of letters
  Type type = Byte;
  std::string_view data;
};

double load_number(const char* at, Type type) {
  constexpr ByteOrder kBig = ByteOrder::Big;
  switch (type) {
    case Short:
      return load<std::int16_t>(at, kBig);
    case Int:
      return load<std::int32_t>(at, kBig);
    case Float:
      return load<float>(at, kBig);
    case Double:
      return load<double>(at, kBig);
    case UShort:
      return load<std::uint16_t>(at, kBig);
    case UInt:
      return load<std::uint32_t>(at, kBig);
    case Int64:
      return static_cast<double>(load<std::int64_t>(at, kBig));
    case UInt64:
      return static_cast<double>(load<std::uint64_t>(at, kBig));
    case UByte:
      return static_cast<unsigned char>(*at);
    default:
      return static_cast<signed char>(*at);
  }
}

class ClassicFile : public NetcdfFile {
 public:
  ClassicFile(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    version_ = bytes[3];
    at_ = 4;
    count();  // of records
    read_list(kDimensions, [&] { read_dimension(); });
    read_list(kAttributes, [&] { read_attribute(nullptr); });
    read_list(kVariables, [&] { read_variable(); });
  }

  std::optional<std::size_t> dimension(const std::string& name) const override {
    for (const auto& [known, length] : dimensions_)
      if (known == name) return length;
    return std::nullopt;
  }

  std::optional<std::vector<std::size_t>> shape(const std::string& variable) const override {
    const auto found = variables_.find(variable);
    if (found == variables_.end()) return std::nullopt;
    return found->second.shape;
  }

  std::vector<double> numbers(const std::string& name) const override {
    const Variable& variable = at(name);
    const std::size_t size = kTypeSize[static_cast<std::size_t>(variable.type)];
    if (variable.type == Char) throw bad_variable(name, "holds letters instead of numbers");
    std::vector<double> values(variable.data.size() / size);
    CancelCheck check_cancelled;
    for (std::size_t i = 0; i < values.size(); ++i) {
      check_cancelled();
      values[i] = load_number(variable.data.data() + i * size, variable.type);
    }
    return values;
  }

  std::string letters(const std::string& name) const override {
    const Variable& variable = at(name);
    if (variable.type != Char) throw bad_variable(name, "holds numbers instead of letters");
    return std::string(variable.data);
  }

  std::string text_attribute(const std::string& variable, const std::string& name) const override {
    const Variable& owner = at(variable);
    const auto found = owner.attributes.find(name);
    return found == owner.attributes.end() ? "" : found->second;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw bad_element(name_, "byte " + std::to_string(at_),
                      message + "; the file is truncated or damaged, export it again");
  }
  Error bad_variable(const std::string& variable, const std::string& message) const {
    return bad_element(name_, "variable '" + variable + "'",
                       "it " + message + "; the file is damaged, export it again");
  }
  const Variable& at(const std::string& name) const {
    const auto found = variables_.find(name);
    if (found == variables_.end()) throw bad_variable(name, "is missing");
    return found->second;
  }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - at_) fail("the header ends early");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::int32_t int32() { return load<std::int32_t>(take(4).data(), ByteOrder::Big); }
  std::uint64_t unsigned32() { return load<std::uint32_t>(take(4).data(), ByteOrder::Big); }
  std::uint64_t unsigned64() { return load<std::uint64_t>(take(8).data(), ByteOrder::Big); }
  std::uint64_t count() { return version_ == 5 ? unsigned64() : unsigned32(); }

  std::string padded(std::uint64_t size) {
    if (size > bytes_.size()) fail("a text is longer than the file");
    const std::string text(take(size));
    take((4 - size % 4) % 4);
    return text;
  }
  std::string text() { return padded(count()); }

  void read_list(std::int32_t tag, const std::function<void()>& read) {
    const std::int32_t found = int32();
    const std::uint64_t size = count();
    if (found != tag && (found != 0 || size != 0)) fail("a list does not begin with its mark");
    for (std::uint64_t i = 0; i < size; ++i) read();  // each takes bytes, so that it ends
  }

  void read_dimension() {
    std::string name = text();
    const std::uint64_t length = count();  // 0: that of the records
    dimensions_.emplace_back(std::move(name), length);
  }

  Type type() {
    const std::int32_t found = int32();
    if (found < Byte || found > UInt64) fail("there is no type " + std::to_string(found));
    return static_cast<Type>(found);
  }

  void read_attribute(Variable* owner) {
    std::string name = text();
    const Type of = type();
    const std::uint64_t size = count();
    if (size > bytes_.size()) fail("an attribute is longer than the file");
    std::string value = padded(size * kTypeSize[static_cast<std::size_t>(of)]);
    while (!value.empty() && value.back() == '\0') value.pop_back();
    if (owner && of == Char) owner->attributes[std::move(name)] = std::move(value);
  }

  void read_variable() {
    const std::string name = text();
    Variable variable;
    bool has_records = false;
    const std::uint64_t rank = count();
    for (std::uint64_t d = 0; d < rank; ++d) {
      const std::uint64_t id = count();
      if (id >= dimensions_.size()) fail("variable '" + name + "' has an unknown dimension");
      variable.shape.push_back(dimensions_[id].second);
      has_records = has_records || (d == 0 && variable.shape[0] == 0);
    }
    read_list(kAttributes, [&] { read_attribute(&variable); });
    variable.type = type();
    count();  // its size, which follows from the dimensions
    const std::uint64_t begin = version_ == 1 ? unsigned32() : unsigned64();
    if (has_records) return;
    set_data(name, begin, variable);
    variables_[name] = std::move(variable);
  }

  void set_data(const std::string& name, std::uint64_t begin, Variable& variable) const {
    std::uint64_t size = kTypeSize[static_cast<std::size_t>(variable.type)];
    for (const std::size_t length : variable.shape) {
      if (length != 0 && size > bytes_.size() / length) throw ends_early(name);
      size *= length;
    }
    if (begin > bytes_.size() || size > bytes_.size() - begin) throw ends_early(name);
    variable.data = bytes_.substr(begin, size);
  }
  Error ends_early(const std::string& name) const {
    return bad_variable(name, "reaches beyond the end of the file");
  }

  std::string_view bytes_;
  const std::string& name_;
  char version_ = 0;
  std::size_t at_ = 0;
  std::vector<std::pair<std::string, std::size_t>> dimensions_;  // by number
  std::map<std::string, Variable> variables_;
};

}  // namespace

bool is_netcdf_classic(std::string_view bytes) {
  return bytes.size() > 4 && bytes.starts_with("CDF") &&
         (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1a\n"); }

std::unique_ptr<NetcdfFile> open_netcdf(std::string_view bytes, const std::string& file_name) {
  if (is_netcdf_classic(bytes)) return std::make_unique<ClassicFile>(bytes, file_name);
  if (is_hdf5(bytes)) return open_netcdf4(bytes, file_name);
  throw bad_file(file_name,
                 "this is no netCDF file, in which Exodus meshes lie; check what was exported");
}

}  // namespace hexwright::io
