// VTK's XML files: the document, and the numbers of its DataArrays in any encoding.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "io/text/encoded_stream.h"

namespace hexwright::io {

/// A parsed file. Raw appended data is no XML, so it is cut out before parsing.
class VtkXmlFile {
 public:
  VtkXmlFile(std::string_view bytes, const std::string& file_name);

  const std::string& name() const { return name_; }
  pugi::xml_node root() const { return root_; }  ///< <VTKFile>

  /// The numbers of a DataArray; bits (type Bit) are unpacked. Throws Error{BadFile} naming the
  /// array.
  std::vector<double> values(const pugi::xml_node& array) const;

 private:
  void parse_xml(std::string_view text);
  std::string decode(const pugi::xml_node& array, const std::string& where) const;
  std::vector<double> text_values(const pugi::xml_node& array, const std::string& where) const;

  const std::string& name_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::string_view appended_;  // after the underscore
  BlockFormat format_;
  bool is_appended_base64_ = false;
};

}  // namespace hexwright::io
