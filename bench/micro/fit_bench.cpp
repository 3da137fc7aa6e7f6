// Carving and fitting: single-vertex solves per second, and output hexes per second of the whole
// stage for a smooth and a sharp shape on one thread and on two.
#include <benchmark/benchmark.h>

#include "hexwright/base/parallel.h"
#include "hexwright/fit/fit.h"

#include "fit/fit_helpers.h"
#include "relax/kernel/vertex_newton.h"

namespace {

using namespace hexwright;
using namespace hexwright::relax;

void solve_vertices(benchmark::State& state) {
  HexMesh mesh = test::box_hex_mesh(20, 20, 20);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> offset(-0.2, 0.2);
  for (Vec3& p : mesh.positions) p += {offset(rng), offset(rng), offset(rng)};
  const VertexStars stars(mesh);
  const ShapeEnergy shape{static_cast<double>(state.range(0)) / 10, 1, 0};
  VertexNewton newton;
  VertexGoal goal;
  goal.max_step = 1;
  for (auto _ : state) {
    IdVector<VertId, Vec3> positions = mesh.positions;
    for (VertId v : positions.ids())
      benchmark::DoNotOptimize(
          newton.solve(v, stars[v], goal, shape, IdSpan<VertId, Vec3>(positions)));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(mesh.num_verts()));
}
BENCHMARK(solve_vertices)->Arg(0)->Arg(9)->ArgName("blend_tenths")->Unit(benchmark::kMillisecond);

void run_fit(benchmark::State& state, const TriMesh& surface) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const Target target = wrap_target(surface);
  const HexMesh grid = test::grid_around(target.tree.box(), target.tree.box().extent().x / 40);
  std::size_t num_hexes = 0;
  for (auto _ : state) num_hexes += fit(grid, target, {}, {}).mesh.num_hexes();
  state.SetItemsProcessed(static_cast<long>(num_hexes));
}

void fit_torus(benchmark::State& state) { run_fit(state, test::torus_surface(1, 0.4, 200, 100)); }
BENCHMARK(fit_torus)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);

void fit_tilted_cube(benchmark::State& state) {
  std::mt19937 rng(5);
  run_fit(state, test::randomly_rotated(test::unit_cube_surface(), rng));
}
BENCHMARK(fit_tilted_cube)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
