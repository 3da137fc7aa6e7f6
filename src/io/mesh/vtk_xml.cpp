// Writes VTK's XML files.
//
// Based on: Kitware, "VTK XML file formats" (VTK documentation): appended raw data, zlib.
#include "io/mesh/vtk_xml.h"

#include <bit>

#include "io/text/encoded_stream.h"

namespace hexwright::io {

VtkXmlWriter::VtkXmlWriter(const std::string& type, const std::string& version)
    : type_(type), version_(version) {}

void VtkXmlWriter::array(const VtkOutArray& array, Kind kind) {
  const std::size_t count = array.is_int ? array.ints.size() : array.reals.size();
  const std::string tuples =
      kind == Kind::Field
          ? " NumberOfTuples=\"" + std::to_string(count / array.num_components) + "\""
          : "";
  if (array.is_int)
    this->array<std::int32_t>(array.name, "Int32", array.num_components, array.ints, tuples);
  else
    this->array<double>(array.name, "Float64", array.num_components, array.reals, tuples);
}

/// Offsets count from behind the underscore that opens the appended data.
void VtkXmlWriter::array_bytes(const std::string& name, const char* type,
                               std::size_t num_components, std::string_view bytes,
                               const std::string& more_attributes) {
  static_assert(std::endian::native == std::endian::little, "arrays are written as they lie");
  xml_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name +
          "\" NumberOfComponents=\"" + std::to_string(num_components) + "\"" + more_attributes +
          " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
  appended_ += encode_compressed_block(bytes);
}

std::string VtkXmlWriter::take() {
  std::string out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type_ + "\" version=\"" +
                    version_ +
                    "\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                    "compressor=\"vtkZLibDataCompressor\">\n";
  out += xml_;
  out += "<AppendedData encoding=\"raw\">\n_";
  out += appended_;
  out += "\n</AppendedData>\n</VTKFile>\n";
  return out;
}

}  // namespace hexwright::io
