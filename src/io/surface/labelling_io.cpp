#include "hexwright/io/labelling_io.h"

#include <string>

#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright {

std::vector<std::uint8_t> read_labelling(const std::filesystem::path& path,
                                         std::size_t num_triangles) {
  const io::FileBytes file = io::read_file(path);
  io::TextScanner scanner(file.bytes, file.name);
  std::vector<std::uint8_t> labels;
  while (scanner.skip_blank()) {
    const std::int64_t label = scanner.integer("a label");
    if (label < 0 || label > 5)
      scanner.fail("label " + std::to_string(label) +
                   " is none of 0 to 5, which stand for +x, -x, +y, -y, +z, -z; a labelling has "
                   "one of them per triangle of the surface");
    labels.push_back(static_cast<std::uint8_t>(label));
  }
  if (labels.size() != num_triangles)
    throw io::bad_file(file.name, "the file holds " + std::to_string(labels.size()) +
                                      " labels, but the surface has " +
                                      std::to_string(num_triangles) +
                                      " triangles; give one label per triangle, in the order of "
                                      "the surface's file");
  return labels;
}

}  // namespace hexwright
