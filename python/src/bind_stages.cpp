// The stages. Each takes its inputs, its options as text, and what to tell while it runs; each
// gives the result's arrays and its report as JSON.
#include <nanobind/nanobind.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/pipeline/report.h"
#include "hexwright/quality/verdict_json.h"

#include "arrays.h"
#include "binders.h"
#include "option_dict.h"
#include "run_stage.h"

namespace hexwright::python {
namespace {

using namespace nb::literals;
using Warnings = std::vector<std::string>;

/// What every stage is called with besides its inputs.
struct Call {
  OptionDict options;
  RunSettings run;
};

/// Pairs of vertices of the surface become segments, which stay right when it is cleaned.
void add_features(const TriMesh& surface, const std::optional<AnyArray>& edges,
                  FeatureOptions& options) {
  if (!edges) return;
  const std::string of = "the surface's " + std::to_string(surface.num_verts()) + " vertices";
  const auto verts =
      to_indices(*edges, 2, {0, static_cast<std::int64_t>(surface.num_verts()), of}, "features");
  for (std::size_t i = 0; i < verts.size(); i += 2)
    options.extra_segments.push_back(
        {surface.positions[VertId(verts[i])], surface.positions[VertId(verts[i + 1])]});
}

nb::tuple mesh(const TriMesh& surface, const std::optional<AnyArray>& features, const Call& call) {
  MeshOptions options;
  apply_options(make_option_table(options), call.options);
  add_features(surface, features, options.target.features);
  MeshResult result;
  std::string report;
  run_stage(call.run, [&](const Context& context) {
    result = mesh_surface(surface, options, context);
    report = report_to_json(result, options, {"", "", num_threads(), {}});
  });
  return nb::make_tuple(std::move(result.mesh), std::move(result.grid), report);
}

nb::tuple grid(const TriMesh& surface, const std::optional<AnyArray>& features, const Call& call) {
  MeshOptions options;
  apply_options(make_grid_option_table(options), call.options);
  add_features(surface, features, options.target.features);
  SizingResult result;
  Warnings warnings = run_stage(
      call.run, [&](const Context& context) { result = size_surface(surface, options, context); });
  const std::string report = sizing_to_json(result);
  return nb::make_tuple(std::move(result.grid), report, warnings);
}

nb::tuple complete_grid(const Grid& grid, const Call& call) {
  CompleteOptions options;
  apply_options(make_option_table(options), call.options);
  CompleteResult result;
  Warnings warnings = run_stage(
      call.run, [&](const Context& context) { result = complete(grid, options, context); });
  const std::string report = complete_to_json(result.report);
  return nb::make_tuple(std::move(result.grid), report, warnings);
}

nb::tuple dual(const Grid& grid, const Call& call) {
  DualStageOptions options;
  apply_options(make_option_table(options), call.options);
  DualResult result;
  Warnings warnings = run_stage(
      call.run, [&](const Context& context) { result = run_dual_stage(grid, options, context); });
  const std::string report = dual_to_json(result.report);
  return nb::make_tuple(std::move(result.mesh), report, warnings);
}

/// The result is judged as check() would judge it.
nb::tuple fit_mesh(const HexMesh& background, const TriMesh& surface,
                   const std::optional<AnyArray>& features, const Call& call) {
  FitStageOptions options;
  apply_options(make_option_table(options), call.options);
  add_features(surface, features, options.target.features);
  FitResult result;
  Verdict verdict;
  Warnings warnings = run_stage(call.run, [&](const Context& context) {
    const Target target = make_target(surface, options.target, context);
    result = fit(to_unit(background, target.frame), target, options.fit, context);
    if (result.mesh.num_hexes() == 0)
      throw Error(ErrorCode::BadGeometry,
                  "no hex lies inside the surface; the mesh and the surface must overlap and the "
                  "hexes be smaller than the object");
    JudgeOptions judged;
    if (options.fit.carve.side != Side::Inside) judged.quads = JudgedQuads::Labeled;
    verdict = judge(result.mesh, target, judged, context);
    result.to_world(target.frame);
    verdict.to_world(target.frame);
  });
  const std::string report = fit_to_json(result.report);
  return nb::make_tuple(std::move(result.mesh), report, verdict_to_json(verdict), warnings);
}

nb::tuple check(const HexMesh& mesh, const TriMesh* surface,
                const std::optional<AnyArray>& features, const Call& call) {
  TargetOptions target;
  apply_options(make_option_table(target.features), call.options);
  if (surface) add_features(*surface, features, target.features);
  Verdict verdict;
  Warnings warnings = run_stage(call.run, [&](const Context& context) {
    verdict = surface ? judge(mesh, *surface, target, {}, context) : judge(mesh, {}, context);
  });
  return nb::make_tuple(verdict_to_json(verdict), verdict_to_text(verdict), warnings);
}

/// Leaves its input as it is.
nb::tuple improve_mesh(const HexMesh& input, const TriMesh* surface, const Call& call) {
  ImproveOptions options;
  apply_options(make_option_table(options), call.options);
  HexMesh result;
  ImproveReport report;
  Warnings warnings = run_stage(call.run, [&](const Context& context) {
    if (const auto issue = input.find_problem())
      throw Error(ErrorCode::BadArgument, issue->message, "mesh");
    std::optional<SurfaceTree> tree;
    if (surface) options.slide_on = &tree.emplace(*surface);
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

using SizeField = std::function<double(double, double, double)>;

nb::tuple polycube(const TetMesh& object, const TetMesh& cube, const SizeField& max_edge,
                   const Call& call) {
  PolycubeOptions options;
  apply_options(make_option_table(options), call.options);
  if (max_edge)
    options.max_edge = [&](const Vec3& p) {
      const nb::gil_scoped_acquire held;
      return max_edge(p.x, p.y, p.z);
    };
  PolycubeResult result;
  Verdict verdict;
  Warnings warnings = run_stage(call.run, [&](const Context& context) {
    result = mesh_polycube(object, cube, options, context);
    verdict = result.verdict;
  });
  for (const std::string& w : result.report.warnings) warnings.push_back(w);
  const std::string report = polycube_to_json(result.report);
  return nb::make_tuple(std::move(result.mesh), std::move(result.grid), report,
                        verdict_to_json(verdict), warnings);
}

std::string evaluate(const TriMesh& surface, const Call& call) {
  EvaluateOptions options = default_evaluate_options();
  apply_options(make_option_table(options), call.options);
  std::string record;
  run_stage(call.run, [&](const Context& context) {
    record = record_to_json(evaluate_model(surface, options, context));
  });
  return record;
}

}  // namespace

void bind_stages(nb::module_& module) {
  nb::class_<Call>(module, "Call", "What every stage is called with besides its inputs.")
      .def(
          "__init__",
          [](Call* self, const OptionDict& options, const nb::object& progress, int threads) {
            new (self) Call{options, {progress, threads}};
          },
          "options"_a, "progress"_a.none(), "threads"_a);
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
