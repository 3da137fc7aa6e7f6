// Any bytes as the labels of a surface's triangles. The first says how many triangles there are.
#include <algorithm>

#include "hexwright/io/labelling_io.h"

#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwright;
  if (size == 0) return 0;
  const std::size_t num_triangles = data[0] % 16;
  constexpr std::array<const char*, 1> kExtensions = {".txt"};
  const auto path = fuzz::write_input(data + 1, size - 1, kExtensions);
  return fuzz::read_input(path, [&](const std::string& file) {
    const auto labels = read_labelling(file, num_triangles);
    fuzz::require(labels.size() == num_triangles, "there is not one label per triangle");
    fuzz::require(std::ranges::all_of(labels, [](std::uint8_t label) { return label < 6; }),
                  "a label is none of the six");
  });
}
