// Reads a CAD file through the installed component.
#include <cstdio>

#include "hexwright/cad/read_cad.h"

int main(int argc, char** argv) {
  if (argc != 2 || !hexwright::can_read_cad()) return 1;
  const hexwright::CadModel model = hexwright::read_cad(argv[1]);
  for (const hexwright::CadFace& face : model.faces)
    std::printf("%s\n", hexwright::describe_face(face).c_str());
  return model.faces.size() == 7 ? 0 : 1;
}
