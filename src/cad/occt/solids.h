// The solids of a shape; loose faces are sewn into solids where they close.
#pragma once

#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include "cad/occt/document.h"

namespace hexwright::cad {

/// Each solid once, placed. What was sewn keeps its names in `document`. Throws Error{BadGeometry}
/// where there is none.
std::vector<TopoDS_Shape> find_solids(Document& document, std::vector<std::string>& notes);

}  // namespace hexwright::cad
