// The parts of an evaluation in order, each on its own so that one's failure spares the others.
#include "hexwright/pipeline/evaluate.h"

#include <new>

#include "hexwright/base/error.h"

#include "base/stage_log.h"
#include "io/grid/grid_file.h"

namespace hexwright {
namespace {

/// Runs a part; what it throws, other than a cancellation, becomes a message.
template <class Part>
std::string message_of(Part&& part) {
  try {
    part();
    return {};
  } catch (const Error& e) {
    if (e.code() == ErrorCode::Cancelled) throw;
    return e.what();
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  }
}

/// Made in the unit frame, where criteria are independent of the model's units.
SizingResult make_input_grid(const TriMesh& surface, const EvaluateOptions& options,
                             const Context& context) {
  const TargetOptions as_given = {Placement::AsGiven, options.mesh.target.features, {}};
  const Target target = make_target(surface, as_given, context);
  SizingResult result = build_grid(target, options.sizing, context);
  result.to_world(target.frame);
  return result;
}

/// The record is filled as far as the work gets: a grid without hexes is a result too, when the
/// dual runs out of memory.
void run_method(const Grid& input, const Method& method, const EvaluateOptions& options,
                const Context& context, MethodRecord& record) {
  Stopwatch clock;
  CompleteResult completed = complete(input, method.complete, context);
  record.seconds = clock.seconds();
  record.report = std::move(completed.report);
  record.grid = std::move(completed.grid);
  record.cells_per_level = count_cells_per_level(record.grid);
  if (!options.run_dual) return;
  DualOptions dual;
  dual.mode = method.complete.pairing == Pairing::Sheets ? DualMode::Sheets : DualMode::Blocks;
  clock = Stopwatch();
  record.dual = build_dual(record.grid, dual, context).report;
  record.dual_seconds = clock.seconds();
}

}  // namespace

const std::array<Method, kNumMethods>& evaluated_methods() {
  static const std::array<Method, kNumMethods> kMethods = {{
      {"octree_strong", "octree + strong", {Balance::Strong, Pairing::Octree}},
      {"octree_weak", "octree + weak", {Balance::Weak, Pairing::Octree}},
      {"blocks", "blocks", {Balance::Weak, Pairing::Blocks}},
      {"sheets", "sheets", {Balance::Weak, Pairing::Sheets}},
  }};
  return kMethods;
}

EvaluateOptions default_evaluate_options() {
  EvaluateOptions options;
  options.sizing.sizing = Sizing::Thickness;
  options.sizing.margin = 0;
  options.sizing.min_level = 0;
  options.sizing.max_level = 6;
  options.sizing.max_cells = 300'000;
  return options;
}

double MethodRecord::relative_growth() const {
  return report.num_input_cells == 0
             ? 0
             : static_cast<double>(growth()) / static_cast<double>(report.num_input_cells);
}

ModelRecord evaluate_model(const TriMesh& surface, const EvaluateOptions& options,
                           const Context& context,
                           const std::function<void(const ModelRecord&)>& on_part) {
  const auto watch = context.watch();
  ModelRecord record;
  record.num_verts = surface.num_verts();
  record.num_tris = surface.num_tris();
  const auto report_part = [&] {
    if (on_part) on_part(record);
  };

  // The input grid.
  const Stopwatch clock;
  SizingResult sizing = make_input_grid(surface, options, context);
  record.sizing_seconds = clock.seconds();
  record.hit_cell_budget = sizing.hit_cell_budget;
  record.input = std::move(sizing.grid);
  record.input_cells_per_level = count_cells_per_level(record.input);
  report_part();

  // Every completion of it.
  for (int m = 0; m < kNumMethods; ++m) {
    context.check_cancelled();
    MethodRecord& method = record.methods[m];
    method.failure = message_of(
        [&] { run_method(record.input, evaluated_methods()[m], options, context, method); });
    report_part();
  }

  // The whole pipeline.
  if (options.run_mesh) {
    record.mesh_failure =
        message_of([&] { record.mesh = mesh_surface(surface, options.mesh, context); });
    report_part();
  }
  return record;
}

HexMesh leaves_as_hexes(const Grid& grid) { return io::grid_to_hexes(grid); }

}  // namespace hexwright
