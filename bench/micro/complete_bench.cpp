// Balance and pairing on generated grids of growing size.
//
// Arguments of every case: shape (0 sphere, 1 gyroid, 2 random points), depth, threads. Counters:
// input leaves per second, leaves in and out, peak memory of the process per output leaf. The cases
// "growth" run from 10^4 to 10^8 leaves; `lab/run.py growth` makes a table of them.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include <benchmark/benchmark.h>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/complete.h"
#include "hexwright/grid/refine.h"

#include "grid_shapes.h"

namespace hexwright::bench {
namespace {

/// Forgets the process's peak memory, so that each case is measured by itself (Linux).
void reset_peak_memory() {
  if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", file);
    std::fclose(file);
  }
}

/// Peak resident bytes since the last reset; 0 where /proc is missing.
double peak_memory() {
  double kilobytes = 0;
  if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, file))
      if (std::strncmp(line, "VmHWM:", 6) == 0) std::sscanf(line + 6, "%lf", &kilobytes);
    std::fclose(file);
  }
  return kilobytes * 1024;
}

/// The grid of the current arguments; kept, because cases with the same grid follow each other.
const Grid& shape_grid(int shape, int depth) {
  static std::unique_ptr<Grid> grid;
  static int made_shape = -1, made_depth = -1;
  if (shape != made_shape || depth != made_depth) {
    grid.reset();
    grid = std::make_unique<Grid>(make_shape_grid(static_cast<Shape>(shape), depth));
    made_shape = shape;
    made_depth = depth;
  }
  return *grid;
}

void run(benchmark::State& state, const CompleteOptions& options, std::size_t threads_at = 2) {
  const Grid& grid = shape_grid(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const ThreadLimit limit(static_cast<int>(state.range(threads_at)));
  std::size_t num_output = 0;
  reset_peak_memory();
  for (auto _ : state) {
    const CompleteResult result = complete(grid, options, {});
    num_output = result.grid.num_cells();
    benchmark::DoNotOptimize(num_output);
  }
  state.counters["leaves_in"] = static_cast<double>(grid.num_cells());
  state.counters["leaves_out"] = static_cast<double>(num_output);
  state.counters["peak_B_per_leaf"] = peak_memory() / static_cast<double>(num_output);
  state.counters["leaves_per_s"] = benchmark::Counter(
      static_cast<double>(grid.num_cells()), benchmark::Counter::kIsIterationInvariantRate);
}

void balance_strong(benchmark::State& state) {
  run(state, {Balance::Strong, Pairing::None, false});
}
void octree_weak(benchmark::State& state) { run(state, {Balance::Weak, Pairing::Octree, false}); }
void blocks_sweep(benchmark::State& state) { run(state, {Balance::Weak, Pairing::Blocks, false}); }
void blocks_descent(benchmark::State& state) { run(state, {Balance::Weak, Pairing::Blocks, true}); }

/// Building the octree of a sphere from a size function, to set beside pairing it.
void build_octree(benchmark::State& state) {
  const int depth = static_cast<int>(state.range(1));
  const ThreadLimit limit(static_cast<int>(state.range(2)));
  const auto meets_sphere = [](const Box3& box, int level) {
    const double h = box.extent().x;
    return level < 2 || std::abs(distance(box.center(), {0.5, 0.5, 0.5}) - 0.41) < 0.87 * h;
  };
  std::size_t num_cells = 0;
  for (auto _ : state)
    num_cells = refine_where({{0, 0, 0}, 1}, {{0, 0, 0}}, depth, meets_sphere).num_cells();
  state.counters["leaves_out"] = static_cast<double>(num_cells);
  state.counters["leaves_per_s"] = benchmark::Counter(
      static_cast<double>(num_cells), benchmark::Counter::kIsIterationInvariantRate);
}

void sphere_sizes(benchmark::internal::Benchmark* b) {
  for (const int depth : {5, 7, 9})
    for (const int threads : {1, 2}) b->Args({0, depth, threads});
  b->ArgNames({"shape", "depth", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

void sizes(benchmark::internal::Benchmark* b) {
  for (int shape = 0; shape < 3; ++shape)
    for (const int depth : {5, 7, 9})
      for (const int threads : {1, 2}) b->Args({shape, depth, threads});
  b->ArgNames({"shape", "depth", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

constexpr CompleteOptions kGrowthModes[] = {{Balance::Strong, Pairing::None, false},
                                            {Balance::Weak, Pairing::Blocks, false},
                                            {Balance::Weak, Pairing::Blocks, true}};

/// One case per grid, mode and number of threads; the grid outermost, because large ones take as
/// long to make as to complete, and threads innermost, so that both meet the same machine.
void growth(benchmark::State& state) { run(state, kGrowthModes[state.range(2)], 3); }

/// Five sizes per shape, about 10^4 to 10^8 leaves in (points: out).
void growth_sizes(benchmark::internal::Benchmark* b) {
  constexpr int kDepths[][5] = {{5, 7, 9, 10, 12}, {5, 6, 8, 9, 11}, {5, 6, 8, 9, 11}};
  for (int shape = 0; shape < 3; ++shape)
    for (const int depth : kDepths[shape])
      for (int mode = 0; mode < 3; ++mode)
        for (const int threads : {1, 2}) b->Args({shape, depth, mode, threads});
  b->ArgNames({"shape", "depth", "mode", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(build_octree)->Apply(sphere_sizes);
BENCHMARK(balance_strong)->Apply(sizes);
BENCHMARK(octree_weak)->Apply(sizes);
BENCHMARK(blocks_sweep)->Apply(sizes);
BENCHMARK(blocks_descent)->Apply(sizes);
BENCHMARK(growth)->Apply(growth_sizes);

}  // namespace
}  // namespace hexwright::bench
