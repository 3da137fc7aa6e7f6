// hexwright._core: the library as numpy arrays and functions. The package's public names are in
// python/hexwright/.
#include <nanobind/nanobind.h>

#include "hexwright/version.h"

#include "binders.h"
#include "errors.h"

NB_MODULE(_core, module) {
  namespace python = hexwright::python;
  module.doc() = "The compiled part of hexwright; use the package's own names instead.";
  module.attr("version") = HEXWRIGHT_VERSION;
  python::register_errors();
  python::bind_surface(module);
  python::bind_mesh(module);
  python::bind_grid(module);
  python::bind_options(module);
  python::bind_stages(module);
}
