#include "dual/complex/base_mesh.h"

namespace hexwright::dual {

BaseStatus build_base_mesh(const Domain& domain, HexComplex& complex) {
  if (!domain.is_box()) return build_general_base(domain, complex);
  build_box_base(domain, complex);
  return BaseStatus::Ok;
}

}  // namespace hexwright::dual
