// From solids to the neutral model.
#pragma once

#include <vector>

#include "hexwright/cad/read_cad.h"

#include "cad/occt/document.h"

namespace hexwright::cad {

/// Triangulates the solids and fills everything but notes and unit. Throws Error{BadGeometry} where
/// nothing can be triangulated.
CadModel build_model(const Document& document, const std::vector<TopoDS_Shape>& solids,
                     const CadReadOptions& options);

}  // namespace hexwright::cad
