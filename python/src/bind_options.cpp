// The tables of options, to list and to read Python's keywords with.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"

#include "binders.h"
#include "option_dict.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;

const char* kind_name(OptionKind kind) {
  switch (kind) {
    case OptionKind::Flag:
      return "flag";
    case OptionKind::Whole:
      return "whole";
    case OptionKind::Number:
      return "number";
    case OptionKind::Share:
      return "share";
    case OptionKind::Degrees:
      return "degrees";
    case OptionKind::Choice:
      return "choice";
  }
  return "";
}

/// Name, kind, what is allowed, default and help of each row.
nb::list describe(const OptionTable& table) {
  nb::list rows;
  for (const NamedOption& row : table)
    rows.append(nb::make_tuple(row.name, kind_name(row.kind), row.allowed, row.fallback, row.help));
  return rows;
}

template <class Options>
nb::list describe_defaults(Options options = {}) {
  return describe(make_option_table(options));
}

nb::list option_table(const std::string& stage) {
  if (stage == "mesh") return describe_defaults<MeshOptions>();
  if (stage == "complete") return describe_defaults<CompleteOptions>();
  if (stage == "dual") return describe_defaults<DualStageOptions>();
  if (stage == "fit") return describe_defaults<FitOptions>();
  if (stage == "improve") return describe_defaults<ImproveOptions>();
  if (stage == "polycube") return describe_defaults<PolycubeOptions>();
  if (stage == "check") return describe_defaults<FeatureOptions>();
  if (stage == "evaluate") return describe_defaults(default_evaluate_options());
  if (stage == "grid") {
    MeshOptions options;
    return describe(make_grid_option_table(options));
  }
  throw Error(ErrorCode::BadArgument, "no stage is called '" + stage + "'");
}

}  // namespace

/// In the table's order, not the caller's: the result must not depend on how keywords are ordered.
void apply_options(const OptionTable& table, const OptionDict& given) {
  for (const NamedOption& row : table) {
    const auto value = given.find(row.name);
    if (value == given.end()) continue;
    try {
      row.set(value->second);
    } catch (const Error& e) {
      throw Error(e.code(), e.what(), row.name);
    }
  }
}

void bind_options(nb::module_& module) { module.def("option_table", &option_table, "stage"_a); }

}  // namespace hexwright::python
