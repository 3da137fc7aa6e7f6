// Any bytes as a hex mesh and as a tet mesh: MEDIT, legacy VTK, VTU, Gmsh, Abaqus, MFEM, Exodus.
#include "hexwright/io/mesh_io.h"

#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwright;
  constexpr std::array<const char*, 7> kExtensions = {".mesh", ".vtk",  ".vtu", ".msh",
                                                      ".inp",  ".mfem", ".exo"};
  fuzz::read_input(fuzz::write_input(data, size, kExtensions), [](const std::string& path) {
    fuzz::require(!read_hex_mesh(path).find_problem(), "the hex mesh is not sound");
  });
  return fuzz::read_input(fuzz::write_input(data, size, kExtensions), [](const std::string& path) {
    fuzz::require(!read_tet_mesh(path).find_problem(), "the tet mesh is not sound");
  });
}
