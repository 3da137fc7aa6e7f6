// A polycube on an even lattice, without a map to suit it to.
#pragma once

#include "polycube/lattice/charts.h"
#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

/// `spacing` 0 derives it: geometric_spacing().
inline Lattice fit_lattice(const TetMesh& polycube, double spacing,
                           std::size_t max_roots = 2'000'000) {
  const Faces faces = find_faces(polycube, spacing);
  if (spacing <= 0) spacing = geometric_spacing(faces.planes);
  return place_on_lattice(faces, even_scales(faces.planes, spacing), spacing, max_roots);
}

}  // namespace hexwright::polycube
