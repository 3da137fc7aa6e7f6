// VTK's XML files: the document, and the numbers of its DataArrays in any encoding.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "io/mesh/volume_file.h"
#include "io/mesh/vtk_cells.h"
#include "io/text/encoded_stream.h"

namespace hexwright::io {

/// A parsed file. Raw appended data is no XML, so it is cut out before parsing.
class VtkXmlFile {
 public:
  explicit VtkXmlFile(const VolumeSource& source);

  const std::string& name() const { return source_.name; }
  pugi::xml_node root() const { return root_; }  ///< <VTKFile>

  /// The numbers of a DataArray; bits (type Bit) are unpacked. Throws Error{BadFile} naming the
  /// array.
  std::vector<double> values(const pugi::xml_node& array) const;

 private:
  void parse_xml(std::string_view text);
  std::string decode(const pugi::xml_node& array, const std::string& where) const;
  std::vector<double> text_values(const pugi::xml_node& array, const std::string& where) const;

  VolumeSource source_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::string_view appended_;  // after the underscore
  BlockFormat format_;
  bool is_appended_base64_ = false;
};

/// Writes a file with zlib-compressed raw appended data, 64-bit headers, little endian.
class VtkXmlWriter {
 public:
  enum class Kind { Data, Field };  ///< field arrays also state their number of tuples

  explicit VtkXmlWriter(const std::string& type, const std::string& version = "1.0");

  void open(const std::string& tag) { xml_ += "<" + tag + ">\n"; }
  void close(const std::string& tag) { xml_ += "</" + tag + ">\n"; }
  /// A whole line of XML.
  void line(const std::string& text) { xml_ += text + "\n"; }

  void array(const VtkOutArray& array, Kind kind);
  template <class T>
  void array(const std::string& name, const char* type, std::size_t num_components,
             std::span<const T> values, const std::string& more_attributes = {}) {
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof(T));
    array_bytes(name, type, num_components, bytes, more_attributes);
  }

  std::string take();

 private:
  void array_bytes(const std::string& name, const char* type, std::size_t num_components,
                   std::string_view bytes, const std::string& more_attributes);

  std::string type_;
  std::string version_;
  std::string xml_;
  std::string appended_;
};

}  // namespace hexwright::io
