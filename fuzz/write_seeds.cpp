// Writes small surfaces of the formats that are only read, as seeds. Usage: write_seeds FOLDER.
#include <filesystem>
#include <fstream>

#include "io/surface_samples.h"

int main(int argc, char** argv) {
  using namespace hexwright;
  if (argc != 2) return 2;
  // fuzz_surface takes an input for Nastran, which has no mark, by its size; the end is not read.
  std::string nastran = test::kNastranTetrahedron;
  while (nastran.size() % 5 != 4) nastran += '\n';
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"tetrahedron.msh", test::kGmshTetrahedron},
           {"tetrahedron.vtk", test::kVtkTetrahedron},
           {"tetrahedron.vtp", test::kVtpTetrahedron},
           {"tetrahedron.bdf", nastran},
           {"tetrahedra.3mf", test::zip_of({{"a.model", test::k3mfModel}})}}) {
    std::ofstream file(folder / name, std::ios::binary);
    if (!(file << bytes).flush()) return 1;
  }
  return 0;
}
