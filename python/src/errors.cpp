// The library's errors as Python exceptions.
#include "errors.h"

#include <exception>

#include "hexwright/base/error.h"

namespace hexwright::python {
namespace {

namespace nb = nanobind;

const char* class_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadArgument:
    case ErrorCode::CannotOpen:
    case ErrorCode::BadFile:
      return "BadInput";
    case ErrorCode::BadGeometry:
      return "BadGeometry";
    case ErrorCode::OutOfResources:
      return "OutOfResources";
    case ErrorCode::Cancelled:
      return "Cancelled";
  }
  return "HexwrightError";
}

void translate(const std::exception_ptr& failure, void*) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& e) {
    const nb::object type = nb::module_::import_("hexwright._errors").attr(class_of(e.code()));
    const nb::object error = type(nb::str(e.what()));
    error.attr("where") = nb::str(e.where().c_str());
    PyErr_SetObject(type.ptr(), error.ptr());
  }
}

}  // namespace

void register_errors() { nb::register_exception_translator(translate); }

}  // namespace hexwright::python
