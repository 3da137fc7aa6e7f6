// Any bytes as feature edges of a surface: polylines, or pairs of vertex numbers.
#include "hexwright/base/vec3.h"
#include "hexwright/io/feature_io.h"

#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwright;
  TriMesh surface;
  for (int v = 0; v < 8; ++v)
    surface.positions.push_back({double(v & 1), double(v >> 1 & 1), double(v >> 2)});
  surface.tris.push_back({VertId(0), VertId(1), VertId(2)});
  constexpr std::array<const char*, 2> kExtensions = {".txt", ".obj"};
  return fuzz::read_input(fuzz::write_input(data, size, kExtensions), [&](const std::string& path) {
    for (const auto& [a, b] : read_feature_edges(path, surface))
      fuzz::require(is_finite(a) && is_finite(b), "a feature edge is not finite");
  });
}
