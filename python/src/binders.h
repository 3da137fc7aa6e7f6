// The parts of the module, each adding its classes and functions.
#pragma once

#include <nanobind/nanobind.h>

namespace hexwright::python {

namespace nb = nanobind;

void bind_surface(nanobind::module_& module);
void bind_mesh(nanobind::module_& module);
void bind_grid(nanobind::module_& module);
void bind_options(nanobind::module_& module);
void bind_stages(nanobind::module_& module);

}  // namespace hexwright::python
