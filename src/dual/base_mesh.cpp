#include "dual/base_mesh.h"

#include "hexwright/base/error.h"

namespace hexwright::dual {

void build_base_mesh(const Domain& domain, HexComplex& complex) {
  if (domain.is_box()) return build_box_base(domain, complex);
  throw Error(ErrorCode::BadGeometry, "domains other than boxes are not handled yet");
}

}  // namespace hexwright::dual
