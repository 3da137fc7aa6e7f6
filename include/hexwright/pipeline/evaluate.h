// The paper's evaluation of one surface: the same input grid through every completion, and the
// whole pipeline beside it.
//
// Based on: Pitzalis et al. 2021, section 6.1 (input grid by thickness, growth of the grid).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// A way of making a grid hexmeshable.
struct Method {
  const char* key;    ///< in machine-readable results
  const char* title;  ///< for people
  CompleteOptions complete;
};

/// Octree pairing under strong and weak balance (the prior art), blocks (the paper) and sheets.
inline constexpr int kNumMethods = 4;
const std::array<Method, kNumMethods>& evaluated_methods();

struct EvaluateOptions {
  SizingOptions sizing;  ///< of the input grid
  MeshOptions mesh;      ///< of the whole pipeline, which sizes its own grid
  bool run_dual = true;  ///< build the dual hex mesh of each completed grid
  bool run_mesh = true;
};

/// The paper's input grid: by thickness, in the smallest cube around the object, at most 6 levels
/// and 300,000 cells.
EvaluateOptions default_evaluate_options();

/// What one method made of the input grid.
struct MethodRecord {
  CompleteReport report;
  std::vector<std::size_t> cells_per_level;
  double seconds = 0;              ///< of completion
  std::optional<DualReport> dual;  ///< whole root cube, nothing carved
  double dual_seconds = 0;
  std::string failure;  ///< why there is no result; empty = done
  Grid grid;            ///< in the surface's coordinates

  bool has_grid() const { return grid.num_cells() > 0; }
  /// Cells added, and that per input cell (the paper's absolute and relative growth).
  std::size_t growth() const { return report.num_output_cells - report.num_input_cells; }
  double relative_growth() const;
};

struct ModelRecord {
  std::size_t num_verts = 0, num_tris = 0;  ///< of the surface as read
  Grid input;                               ///< the input grid
  std::vector<std::size_t> input_cells_per_level;
  bool hit_cell_budget = false;
  double sizing_seconds = 0;
  std::array<MethodRecord, kNumMethods> methods;  ///< in the order of evaluated_methods()
  std::optional<MeshResult> mesh;
  std::string mesh_failure;  ///< the error that left no mesh; empty = none
};

/// Evaluates one surface. `on_part` (may be empty) sees the record after each part, so that a run
/// that is cut short keeps what was done. A method or mesh that fails leaves its message; the
/// others still run. Counts are the same for any thread count; seconds are not.
/// Errors: those of prepare_surface and build_grid, and Cancelled.
ModelRecord evaluate_model(const TriMesh& surface, const EvaluateOptions& options,
                           const Context& context,
                           const std::function<void(const ModelRecord&)>& on_part = {});

/// The record as one JSON object (keys: docs/evaluation.md), on one line when `indent` < 0.
std::string record_to_json(const ModelRecord& record, int indent = -1);

/// The options that results depend on, as one JSON object on one line.
std::string evaluate_options_to_json(const EvaluateOptions& options);

/// A hex per leaf, vertices shared: non-conforming where levels meet. The region is the level.
HexMesh leaves_as_hexes(const Grid& grid);

}  // namespace hexwright
