// Writes VTK's XML files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/content/volume_file.h"
#include "io/mesh/vtk_cells.h"

namespace hexwright::io {

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
