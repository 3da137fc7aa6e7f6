// The header is built twice: its length decides where the data begin, and it says so.
#include "io/text/netcdf_writer.h"

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"

#include "io/text/byte_reader.h"

namespace hexwright::io {
namespace {

constexpr std::int32_t kDimensions = 0x0A, kVariables = 0x0B, kAttributes = 0x0C;

void put(std::string& out, std::int32_t value) { store(out, value, ByteOrder::Big); }

void pad(std::string& out) { out.append((4 - out.size() % 4) % 4, '\0'); }

void put_name(std::string& out, const std::string& name) {
  put(out, static_cast<std::int32_t>(name.size()));
  out += name;
  pad(out);
}

/// The head of a list; an empty one is two zeros.
void put_list(std::string& out, std::int32_t tag, std::size_t count) {
  put(out, count == 0 ? 0 : tag);
  put(out, static_cast<std::int32_t>(count));
}

template <class Number>
std::string bytes_of(std::span<const Number> values) {
  std::string bytes;
  bytes.reserve(values.size_bytes());
  CancelCheck check_cancelled;
  for (Number value : values) {
    check_cancelled();
    store(bytes, value, ByteOrder::Big);
  }
  return bytes;
}

}  // namespace

std::int32_t NetcdfWriter::dimension(const std::string& name, std::size_t length) {
  dimensions_.push_back({name, length});
  return static_cast<std::int32_t>(dimensions_.size() - 1);
}

void NetcdfWriter::text_attribute(const std::string& name, const std::string& value) {
  put_name(attributes_, name);
  put(attributes_, Char);
  put_name(attributes_, value);
  ++num_attributes_;
}

void NetcdfWriter::int_attribute(const std::string& name, std::int32_t value) {
  put_name(attributes_, name);
  put(attributes_, Int);
  put(attributes_, 1);
  put(attributes_, value);
  ++num_attributes_;
}

void NetcdfWriter::float_attribute(const std::string& name, float value) {
  put_name(attributes_, name);
  put(attributes_, Float);
  put(attributes_, 1);
  store(attributes_, value, ByteOrder::Big);
  ++num_attributes_;
}

void NetcdfWriter::add(Variable&& variable) {
  constexpr std::size_t kLargest = 0xfffffffcu;
  if (variable.data.size() > kLargest)
    throw Error(ErrorCode::OutOfResources,
                "the mesh is too large for this format; write it as .vtu");
  pad(variable.data);
  variable.size = variable.data.size();
  variables_.push_back(std::move(variable));
}

void NetcdfWriter::ints(const std::string& name, const std::vector<std::int32_t>& dimensions,
                        std::span<const std::int32_t> data, const TextAttribute& text) {
  add({name, dimensions, text, Int, bytes_of(data), 0});
}

void NetcdfWriter::doubles(const std::string& name, const std::vector<std::int32_t>& dimensions,
                           std::span<const double> data) {
  add({name, dimensions, {}, Double, bytes_of(data), 0});
}

void NetcdfWriter::record_doubles(const std::string& name, std::int32_t unlimited) {
  variables_.push_back({name, {unlimited}, {}, Double, {}, sizeof(double)});
}

void NetcdfWriter::texts(const std::string& name, const std::vector<std::int32_t>& dimensions,
                         const std::vector<std::string>& rows, std::size_t length) {
  Variable v{name, dimensions, {}, Char, {}, 0};
  for (std::string row : rows) {
    row.resize(length, '\0');
    v.data += row;
  }
  add(std::move(v));
}

std::string NetcdfWriter::header(const std::vector<std::uint64_t>& begins) const {
  std::string out("CDF\x02", 4);
  put(out, 0);  // records
  put_list(out, kDimensions, dimensions_.size());
  for (const Dimension& d : dimensions_) {
    put_name(out, d.name);
    put(out, static_cast<std::int32_t>(d.length));
  }
  put_list(out, kAttributes, static_cast<std::size_t>(num_attributes_));
  out += attributes_;
  put_list(out, kVariables, variables_.size());
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Variable& v = variables_[i];
    put_name(out, v.name);
    put(out, static_cast<std::int32_t>(v.dimensions.size()));
    for (std::int32_t d : v.dimensions) put(out, d);
    put_list(out, kAttributes, v.attribute.name.empty() ? 0 : 1);
    if (!v.attribute.name.empty()) {
      put_name(out, v.attribute.name);
      put(out, Char);
      put_name(out, v.attribute.value);
    }
    put(out, v.type);
    store(out, static_cast<std::uint32_t>(v.size), ByteOrder::Big);
    store(out, begins[i], ByteOrder::Big);
  }
  return out;
}

std::string NetcdfWriter::take() {
  std::vector<std::uint64_t> begins(variables_.size(), 0);
  std::uint64_t at = header(begins).size();
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    begins[i] = at;
    at += variables_[i].data.size();
  }
  std::string out = header(begins);
  out.reserve(at);
  for (Variable& v : variables_) {
    out += v.data;
    v.data = {};
  }
  return out;
}

}  // namespace hexwright::io
