// Consistent and outward orientation of a surface, component by component.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct Orientation {
  std::size_t num_repaired = 0;       ///< triangles turned to agree with their neighbours
  std::size_t num_turned_parts = 0;   ///< components turned inside out as a whole
  std::size_t num_parts = 0;          ///< components connected across edges of two triangles
  std::size_t num_twisted_edges = 0;  ///< edges where no consistent orientation exists
};

/// Turns triangles of `mesh` (in the unit frame). Inside a component the larger area wins. A
/// component that is consistent keeps its orientation relative to the outermost closed component
/// around it, and that one is made to point outwards; so cavities stay cavities.
Orientation orient_surface(TriMesh& mesh, const Context& context);

}  // namespace hexwright
