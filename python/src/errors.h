// The library's errors as Python exceptions.
#pragma once

#include <nanobind/nanobind.h>

namespace hexwright::python {

/// Makes hexwright::Error arrive as BadInput, BadGeometry, OutOfResources or Cancelled of
/// hexwright._errors, with the place as the attribute `where`.
void register_errors();

}  // namespace hexwright::python
