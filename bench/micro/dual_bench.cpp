// The dual stage on grids refined around a sphere, by number of levels: topology alone, and all.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/grid/complete.h"

#include "dual/build_complex.h"

namespace hexwright {
namespace {

// Leaves that meet the sphere of radius 0.4 about the cube's centre are split down to `level`.
Grid sphere_grid(int level, const CompleteOptions& options) {
  Grid grid = make_root_grid({{0, 0, 0}, 1});
  for (int l = 0; l < level; ++l) {
    std::vector<char> marks(grid.num_cells(), 0);
    for (CellId c : grid.cells.ids()) {
      const Box3 box = cell_box(grid, c);
      const double offset = distance(box.center(), {0.5, 0.5, 0.5}) - 0.4;
      marks[c.index()] = l < 2 || std::abs(offset) < 0.6 * box.extent().x;
    }
    grid = split_cells(grid, marks);
  }
  return complete(grid, options, {}).grid;
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

constexpr CompleteOptions kBlocks{Balance::Weak, Pairing::Blocks, false};
constexpr CompleteOptions kSheets{Balance::Relaxed, Pairing::Sheets, false};

void topology(benchmark::State& state, const CompleteOptions& options, DualMode mode) {
  const Grid grid = sphere_grid(static_cast<int>(state.range(0)), options);
  const double before = peak_bytes();
  std::size_t num_hexes = 0;
  for (auto _ : state) {
    Grid used;
    num_hexes = dual::build_complex(grid, mode, {}, used).num_hexes();
  }
  state.counters["leaves"] = static_cast<double>(grid.num_cells());
  state.counters["hexes"] = static_cast<double>(num_hexes);
  state.counters["hexes_per_s"] = benchmark::Counter(static_cast<double>(num_hexes),
                                                     benchmark::Counter::kIsIterationInvariantRate);
  // Growth of the process's peak: right for the first, largest run only.
  state.counters["bytes_per_hex"] = (peak_bytes() - before) / static_cast<double>(num_hexes);
}

void whole_stage(benchmark::State& state, const CompleteOptions& options, DualMode mode) {
  const Grid grid = sphere_grid(static_cast<int>(state.range(0)), options);
  DualResult result;
  for (auto _ : state) result = build_dual(grid, {mode, false, true}, {});
  const auto num_hexes = static_cast<double>(result.report.num_hexes);
  state.counters["hexes"] = num_hexes;
  state.counters["min_sj"] = result.report.min_scaled_jacobian;
  state.counters["avg_sj"] = result.report.avg_scaled_jacobian;
  state.counters["hexes_per_s"] =
      benchmark::Counter(num_hexes, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(topology, blocks, kBlocks, DualMode::Blocks)
    ->DenseRange(6, 9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(topology, sheets, kSheets, DualMode::Sheets)
    ->DenseRange(6, 9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_stage, blocks, kBlocks, DualMode::Blocks)
    ->DenseRange(6, 7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_stage, sheets, kSheets, DualMode::Sheets)
    ->DenseRange(6, 7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace hexwright
