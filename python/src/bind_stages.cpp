// The stages. Each takes its inputs, its options as text, and what to tell while it runs; each
// gives the result's arrays and its report as JSON.
#include <type_traits>
#include <utility>
#include <variant>

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/patch_rules.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/inspect.h"
#include "hexwright/pipeline/mesh_cad.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/judge_distance.h"
#include "hexwright/quality/verdict_json.h"

#include "arrays.h"
#include "binders.h"
#include "option_dict.h"
#include "run_stage.h"
#include "size_field.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;
using Warnings = std::vector<std::string>;

/// What every stage is called with besides its inputs.
struct Call {
  OptionDict options;
  RunSettings run;
  std::vector<SizeRule> fields = {};  ///< sizes that are no text
};

template <class Options>
Options read_options(const Call& call) {
  Options options;
  apply_options(make_option_table(options), call.options);
  return options;
}

/// What `work` returns, and what was warned of meanwhile.
template <class Work>
auto run_for(const Call& call, Work&& work) {
  std::pair<std::invoke_result_t<Work, const Context&>, Warnings> done;
  done.second = run_stage(call.run, [&](const Context& context) { done.first = work(context); });
  return done;
}

/// Sizes from Python beside those in words.
MeshOptions read_mesh_options(const Call& call) {
  auto options = read_options<MeshOptions>(call);
  auto& rules = options.sizes.rules;
  rules.insert(rules.end(), call.fields.begin(), call.fields.end());
  return options;
}

/// Pairs of vertices of the surface become segments, which stay right when it is cleaned.
void add_features(const TriMesh& surface, const std::optional<AnyArray>& edges,
                  FeatureOptions& options) {
  if (!edges) return;
  const std::string of = "the surface's " + std::to_string(surface.num_verts()) + " vertices";
  const IndexRange range{0, static_cast<std::int64_t>(surface.num_verts()), of};
  for (const auto& [a, b] : to_elements<2>(*edges, range, "features"))
    options.extra_segments.push_back({surface.positions[a], surface.positions[b]});
}

/// The wall layer of each hex; None when none were asked for.
nb::object give_layer(MeshResult& result) {
  return result.layer.empty() ? nb::none() : give_values(std::move(result.layer.raw()));
}

nb::tuple mesh(const TriMesh& surface, const std::optional<AnyArray>& features, const Call& call) {
  auto options = read_mesh_options(call);
  add_features(surface, features, options.target.features);
  MeshResult result;
  std::string report;
  run_stage(call.run, [&](const Context& context) {
    result = mesh_surface(surface, options, context);
    report = report_to_json(result, {"", "", num_threads(), {}});
  });
  nb::object layer = give_layer(result);
  return nb::make_tuple(std::move(result.mesh), std::move(result.grid), report, layer);
}

/// A CAD file; `rules` as --patch of the command line takes them.
CadInput read_cad_input(const std::string& path, const std::vector<std::string>& rules,
                        const MeshOptions& options) {
  std::vector<PatchRule> parsed;
  for (const std::string& text : rules) {
    parsed.push_back(parse_patch_rule(text));
    for (PatchCondition& condition : parsed.back().conditions)
      if (!condition.path.empty()) condition.surface = read_surface(condition.path).mesh;
  }
  return prepare_cad(read_cad(path, read_options_for(options)), std::move(parsed), options);
}

/// The file's own warnings are the last.
nb::tuple mesh_cad_file(const std::string& path, const std::vector<std::string>& rules,
                        const Call& call) {
  const auto options = read_mesh_options(call);
  MeshResult result;
  std::string report;
  CadInput input;
  run_stage(call.run, [&](const Context& context) {
    input = read_cad_input(path, rules, options);
    result = mesh_cad(input, options, context);
    report = report_to_json(
        result, {path, "", num_threads(), {}, summarize_cad(input.model, input.surface)});
  });
  nb::object layer = give_layer(result);
  return nb::make_tuple(std::move(result.mesh), std::move(result.grid), report, layer,
                        input.num_matched, input.model.warnings);
}

nb::tuple grid(const TriMesh& surface, const std::optional<AnyArray>& features, const Call& call) {
  MeshOptions options;
  apply_options(make_grid_option_table(options), call.options);
  add_features(surface, features, options.target.features);
  auto [sizing, warnings] = run_for(
      call, [&](const Context& context) { return size_surface(surface, options, context); });
  const std::string report = sizing_to_json(sizing);
  return nb::make_tuple(std::move(sizing.grid), report, warnings);
}

nb::tuple complete_grid(const Grid& grid, const Call& call) {
  const auto options = read_options<CompleteOptions>(call);
  auto [result, warnings] =
      run_for(call, [&](const Context& context) { return complete(grid, options, context); });
  return nb::make_tuple(std::move(result.grid), complete_to_json(result.report), warnings);
}

nb::tuple dual(const Grid& grid, const Call& call) {
  const auto options = read_options<DualStageOptions>(call);
  auto [result, warnings] =
      run_for(call, [&](const Context& context) { return run_dual_stage(grid, options, context); });
  return nb::make_tuple(std::move(result.mesh), dual_to_json(result.report), warnings);
}

/// The result is judged as check() would judge it.
nb::tuple fit_mesh(const HexMesh& background, const TriMesh& surface,
                   const std::optional<AnyArray>& features, const Call& call) {
  auto options = read_options<FitStageOptions>(call);
  add_features(surface, features, options.target.features);
  FitStageResult result;
  Verdict verdict;
  const Warnings warnings = run_stage(call.run, [&](const Context& context) {
    const Target target = make_target(surface, options.target, context);
    result = run_fit_stage(to_unit(background, target.frame), target, options, context);
    if (result.fit.mesh.num_hexes() == 0)
      throw Error(ErrorCode::BadGeometry,
                  "no hex lies inside the surface; the mesh and the surface must overlap and the "
                  "hexes be smaller than the object");
    JudgeOptions judged{.bound_gap = kBoundOfTolerance * options.fit.tolerance};
    if (options.fit.carve.side != Side::Inside) judged.quads = JudgedQuads::Labeled;
    verdict = judge(result.fit.mesh, target, judged, context);
    result.to_world(target.frame);
    verdict.to_world(target.frame);
  });
  const std::string report = fit_to_json(result);
  return nb::make_tuple(std::move(result.fit.mesh), report, verdict_to_json(verdict), warnings);
}

nb::tuple check(const HexMesh& mesh, const TriMesh* surface,
                const std::optional<AnyArray>& features, const Call& call) {
  TargetOptions target;
  apply_options(make_option_table(target.features), call.options);
  if (surface) add_features(*surface, features, target.features);
  const auto [verdict, warnings] = run_for(call, [&](const Context& context) {
    const JudgeOptions judged{.bound_gap = kBoundOfTolerance * SizingOptions{}.tolerance};
    return surface ? judge(mesh, *surface, target, judged, context) : judge(mesh, {}, context);
  });
  return nb::make_tuple(verdict_to_json(verdict), verdict_to_text(verdict), warnings);
}

/// Leaves its input as it is.
nb::tuple improve_mesh(const HexMesh& input, const TriMesh* surface, const Call& call) {
  auto options = read_options<ImproveOptions>(call);
  HexMesh result;
  ImproveReport report;
  const Warnings warnings = run_stage(call.run, [&](const Context& context) {
    if (const auto issue = input.find_problem())
      throw Error(ErrorCode::BadArgument, issue->message, "mesh");
    std::optional<Target> target;
    if (surface) options.slide_on = &target.emplace(make_slide_target(*surface));
    result = input;
    report = improve(result, options, context);
  });
  nb::dict figures;
  figures["min_before"] = report.min_before;
  figures["min_after"] = report.min_after;
  figures["avg_before"] = report.avg_before;
  figures["avg_after"] = report.avg_after;
  figures["upper_bound"] = report.upper_bound;
  figures["worst_hex"] = report.worst_hex.value();
  return nb::make_tuple(std::move(result), figures, warnings);
}

/// One length, or a function of Python of the place.
using SizeField = std::variant<double, std::function<double(double, double, double)>>;

std::function<double(const Vec3&)> to_max_edge(const SizeField& size) {
  if (const double* length = std::get_if<double>(&size))
    return [length = *length](const Vec3&) { return length; };
  return [&size](const Vec3& p) {
    const nb::gil_scoped_acquire held;
    return std::get<1>(size)(p.x, p.y, p.z);
  };
}

nb::tuple polycube(const TetMesh& object, const TetMesh& cube,
                   const std::optional<SizeField>& max_edge, const Call& call) {
  auto options = read_options<PolycubeOptions>(call);
  if (max_edge) options.max_edge = to_max_edge(*max_edge);
  auto [result, warnings] = run_for(
      call, [&](const Context& context) { return mesh_polycube(object, cube, options, context); });
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  return nb::make_tuple(std::move(result.mesh), std::move(result.grid),
                        polycube_to_json(result.report), verdict_to_json(result.verdict), warnings);
}

/// What a surface is, as JSON.
std::string inspect(const TriMesh& surface, const Call& call) {
  MeshOptions options;
  apply_options(make_inspect_option_table(options), call.options);
  const auto look = [&](const Context& context) {
    return inspection_to_json(inspect_surface(surface, options, context));
  };
  return run_for(call, look).first;
}

/// With the number of faces that fit each rule, and the file's own warnings.
nb::tuple inspect_cad(const std::string& path, const std::vector<std::string>& rules,
                      const Call& call) {
  MeshOptions options;
  apply_options(make_inspect_option_table(options), call.options);
  CadInput input;
  const auto look = [&](const Context& context) {
    input = read_cad_input(path, rules, options);
    SurfaceInspection inspection =
        inspect_surface(input.surface.surface, options_for_cad(options, input), context);
    inspection.cad = summarize_cad(input.model, input.surface);
    return inspection_to_json(inspection);
  };
  const std::string found = run_for(call, look).first;
  return nb::make_tuple(found, input.num_matched, input.model.warnings);
}

std::string evaluate(const TriMesh& surface, const Call& call) {
  EvaluateOptions options = default_evaluate_options();
  apply_options(make_option_table(options), call.options);
  return run_for(call,
                 [&](const Context& context) {
                   return record_to_json(evaluate_model(surface, options, context));
                 })
      .first;
}

}  // namespace

void bind_stages(nb::module_& module) {
  nb::class_<SizeRule>(module, "SizeRule", "Sizes of cells that are given in numbers.");
  module.def("function_rule", &function_rule, "function"_a);
  module.def("points_rule", &points_rule, "points"_a, "sizes"_a);
  module.def("lattice_rule", &lattice_rule, "values"_a, "counts"_a, "box"_a);
  module.def("surface_rule", &surface_rule, "surface"_a, "sizes"_a);
  nb::class_<Call>(module, "Call", "What every stage is called with besides its inputs.")
      .def(
          "__init__",
          [](Call* self, const OptionDict& options, const nb::object& progress, int threads,
             const std::vector<SizeRule>& fields) {
            new (self) Call{options, {progress, threads}, fields};
          },
          "options"_a, "progress"_a.none(), "threads"_a, "fields"_a);
  module.def(
      "is_cad_file", [](const std::string& path) { return is_cad_file(path); }, "path"_a);
  module.def("can_read_cad", &can_read_cad);
  module.def("mesh_cad", &mesh_cad_file, "path"_a, "rules"_a, "call"_a);
  module.def("inspect", &inspect, "surface"_a, "call"_a);
  module.def("inspect_cad", &inspect_cad, "path"_a, "rules"_a, "call"_a);
  module.def("mesh", &mesh, "surface"_a, "features"_a.none(), "call"_a);
  module.def("grid", &grid, "surface"_a, "features"_a.none(), "call"_a);
  module.def("complete", &complete_grid, "grid"_a, "call"_a);
  module.def("dual", &dual, "grid"_a, "call"_a);
  module.def("fit", &fit_mesh, "background"_a, "surface"_a, "features"_a.none(), "call"_a);
  module.def("check", &check, "mesh"_a, "surface"_a.none(), "features"_a.none(), "call"_a);
  module.def("improve", &improve_mesh, "mesh"_a, "surface"_a.none(), "call"_a);
  module.def("polycube", &polycube, "object"_a, "cube"_a, "max_edge"_a.none(), "call"_a);
  module.def("evaluate", &evaluate, "surface"_a, "call"_a);
}

}  // namespace hexwright::python
