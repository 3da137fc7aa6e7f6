// The tables of options, to list and to read Python's keywords with.
#include <string_view>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
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
    case OptionKind::Length:
      return "length";
    case OptionKind::Degrees:
      return "degrees";
    case OptionKind::File:
      return "file";
    case OptionKind::Text:
      return "text";
    case OptionKind::List:
      return "list";
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

nb::list describe_grid_defaults() {
  MeshOptions options;
  return describe(make_grid_option_table(options));
}

nb::list describe_inspect_defaults() {
  MeshOptions options;
  return describe(make_inspect_option_table(options));
}

struct Stage {
  std::string_view name;
  nb::list (*options)();
};
constexpr Stage kStages[] = {
    {"mesh", [] { return describe_defaults<MeshOptions>(); }},
    {"grid", &describe_grid_defaults},
    {"complete", [] { return describe_defaults<CompleteOptions>(); }},
    {"dual", [] { return describe_defaults<DualStageOptions>(); }},
    {"fit", [] { return describe_defaults<FitStageOptions>(); }},
    {"improve", [] { return describe_defaults<ImproveOptions>(); }},
    {"polycube", [] { return describe_defaults<PolycubeOptions>(); }},
    {"inspect", &describe_inspect_defaults},
    {"check", [] { return describe_defaults<FeatureOptions>(); }},
    {"evaluate", [] { return describe_defaults(default_evaluate_options()); }},
};

nb::list option_table(std::string_view name) {
  std::string known;
  for (const Stage& stage : kStages) {
    if (stage.name == name) return stage.options();
    known.append(known.empty() ? "" : ", ").append(stage.name);
  }
  throw Error(ErrorCode::BadArgument, fmt::format("'{}' is none of {}", name, known), "stage");
}

std::vector<std::string_view> stage_names() {
  std::vector<std::string_view> names;
  for (const Stage& stage : kStages) names.push_back(stage.name);
  return names;
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

void bind_options(nb::module_& module) {
  module.def("stage_names", &stage_names);
  module.def("option_table", &option_table, "stage"_a);
}

}  // namespace hexwright::python
