// Parses VTK's XML files.
//
// Based on: Kitware, "VTK XML file formats" (VTK documentation): inline text, inline base64, and
// appended data, raw or base64; zlib as the only compressor.
#include "io/vtk/vtk_xml_file.h"

#include <bit>
#include <cstring>
#include <limits>

#include "hexwright/base/cancel.h"

#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

/// Every number becomes a double: ids and counts of real files stay far below 2^53.
struct XmlNumberType {
  std::string_view name;
  std::size_t size;
  double (*read)(const char*, ByteOrder);
};

template <class T>
double load_as_double(const char* at, ByteOrder order) {
  return static_cast<double>(load<T>(at, order));
}

constexpr XmlNumberType kTypes[] = {
    {"Int8", 1, load_as_double<std::int8_t>},   {"UInt8", 1, load_as_double<std::uint8_t>},
    {"Int16", 2, load_as_double<std::int16_t>}, {"UInt16", 2, load_as_double<std::uint16_t>},
    {"Int32", 4, load_as_double<std::int32_t>}, {"UInt32", 4, load_as_double<std::uint32_t>},
    {"Int64", 8, load_as_double<std::int64_t>}, {"UInt64", 8, load_as_double<std::uint64_t>},
    {"Float32", 4, load_as_double<float>},      {"Float64", 8, load_as_double<double>}};

// Every byte's bits, highest first, as VTK packs bit arrays.
std::vector<double> unpack_bits(std::string_view bytes, std::size_t count) {
  std::vector<double> bits;
  bits.reserve(8 * bytes.size());
  for (char c : bytes)
    for (int b = 7; b >= 0; --b) bits.push_back(static_cast<unsigned char>(c) >> b & 1);
  if (count < bits.size()) bits.resize(count);
  return bits;
}

/// The parser tells byte offsets, people count lines.
std::size_t line_of(std::string_view text, std::ptrdiff_t offset) {
  std::size_t line = 1;
  for (char c : text.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, offset))))
    line += c == '\n';
  return line;
}

}  // namespace

/// Raw appended data is no XML (any byte may occur in it), so the parser gets the text before it
/// with the open elements closed by hand, and the data is kept as a view into the file.
VtkXmlFile::VtkXmlFile(std::string_view bytes, const std::string& file_name) : name_(file_name) {
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) {
    parse_xml(bytes);
  } else {
    const std::size_t tag_end = bytes.find('>', tag);
    const std::size_t mark = bytes.find('_', tag_end == bytes.npos ? bytes.size() : tag_end);
    if (tag_end == bytes.npos || mark == bytes.npos)
      throw bad_file(name_,
                     "the file ends before its appended data: it is truncated; "
                     "export or download it again");
    appended_ = bytes.substr(mark + 1);
    parse_xml(std::string(bytes.substr(0, tag_end + 1)) + "</AppendedData></VTKFile>");
    is_appended_base64_ =
        std::strcmp(root_.child("AppendedData").attribute("encoding").value(), "raw") != 0;
  }
  format_.order = std::strcmp(root_.attribute("byte_order").value(), "BigEndian") == 0
                      ? ByteOrder::Big
                      : ByteOrder::Little;
  format_.has_wide_headers = std::strcmp(root_.attribute("header_type").value(), "UInt64") == 0;
  const std::string compressor = root_.attribute("compressor").value();
  format_.is_compressed = !compressor.empty();
  if (format_.is_compressed && compressor != "vtkZLibDataCompressor")
    throw bad_file(name_, "the data is compressed with " + compressor +
                              ", which is not supported; write it with zlib or uncompressed");
}

void VtkXmlFile::parse_xml(std::string_view text) {
  const auto result = document_.load_buffer(text.data(), text.size());
  if (!result)
    throw Error(ErrorCode::BadFile,
                std::string("the XML is damaged (") + result.description() +
                    "); export or download the file again",
                name_ + ":" + std::to_string(line_of(text, result.offset)));
  root_ = document_.child("VTKFile");
  if (!root_)
    throw bad_file(
        name_,
        "there is no VTKFile element: this is no file of VTK; give a .vtu, .vtp or .htg file");
}

/// The bytes of one array, from wherever its format says they are. An offset behind the end means a
/// truncated file, the commonest damage of this format.
std::string VtkXmlFile::decode(const pugi::xml_node& array, const std::string& where) const {
  BlockFormat format = format_;
  if (std::strcmp(array.attribute("format").value(), "appended") != 0) {
    format.is_base64 = true;
    return decode_block(array.child_value(), format, where);
  }
  format.is_base64 = is_appended_base64_;
  const auto offset = array.attribute("offset").as_ullong(std::numeric_limits<std::size_t>::max());
  if (offset >= appended_.size())
    throw Error(ErrorCode::BadFile,
                "its data lies behind the end of the file: it is truncated; export it again",
                where);
  return decode_block(appended_.substr(offset), format, where);
}

/// NaN is let through: fields may hold it. Positions and indices are checked by those who use them.
std::vector<double> VtkXmlFile::text_values(const pugi::xml_node& array,
                                            const std::string& where) const {
  std::vector<double> values;
  TextScanner scanner(array.child_value(), where);
  for (auto token = scanner.token(); !token.empty(); token = scanner.token())
    values.push_back(equals_ignoring_case(token, "nan") ? std::numeric_limits<double>::quiet_NaN()
                                                        : scanner.to_real(token, "a value"));
  return values;
}

std::vector<double> VtkXmlFile::values(const pugi::xml_node& array) const {
  const std::string where = name_ + ": DataArray '" + array.attribute("Name").value() + "'";
  if (!array)
    throw bad_file(name_, "an array of points or cells is missing; export the file again");
  if (std::strcmp(array.attribute("format").as_string("ascii"), "ascii") == 0)
    return text_values(array, where);
  const std::string bytes = decode(array, where);
  const std::string_view type_name = array.attribute("type").value();
  if (type_name == "Bit")
    return unpack_bits(bytes, array.attribute("NumberOfTuples").as_ullong(8 * bytes.size()));
  for (const XmlNumberType& type : kTypes) {
    if (type.name != type_name) continue;
    if (bytes.size() % type.size != 0)
      throw Error(ErrorCode::BadFile, "its size is no multiple of its type's; export it again",
                  where);
    std::vector<double> values;
    values.reserve(bytes.size() / type.size);
    CancelCheck check_cancelled;
    for (std::size_t at = 0; at < bytes.size(); at += type.size) {
      check_cancelled();
      values.push_back(type.read(bytes.data() + at, format_.order));
    }
    return values;
  }
  throw Error(ErrorCode::BadFile,
              "unknown number type " + in_quotes(type_name) + "; export the file again", where);
}

}  // namespace hexwright::io
