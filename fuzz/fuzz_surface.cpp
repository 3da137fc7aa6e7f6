// Any bytes as a surface: OBJ, OFF, STL, PLY, VTK, Gmsh, Nastran, 3MF.
#include "hexwright/io/surface_io.h"

#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwright;
  constexpr std::array<const char*, 5> kExtensions = {".obj", ".off", ".stl", ".ply", ".bdf"};
  return fuzz::read_input(fuzz::write_input(data, size, kExtensions), [](const std::string& path) {
    const SurfaceFile file = read_surface(path);
    fuzz::require(!file.mesh.find_problem(), "the surface is not sound");
    fuzz::require(file.mesh.num_tris() > 0, "a surface without triangles was not refused");
  });
}
