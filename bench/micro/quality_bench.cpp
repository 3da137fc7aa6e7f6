// The judge's parts on a distorted box of n^3 hexes, and the distance to its own boundary, shifted.
#include <cmath>

#include <benchmark/benchmark.h>

#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/hex_topology.h"
#include "hexwright/quality/surface_distance.h"

#include "helpers.h"

namespace hexwright {
namespace {

HexMesh distorted_box(long n) {
  HexMesh mesh = test::box_hex_mesh(static_cast<int>(n), static_cast<int>(n), static_cast<int>(n));
  for (Vec3& p : mesh.positions)
    p += 0.2 * Vec3{std::sin(3 * p.y + p.z), std::sin(2 * p.x), std::cos(p.x + p.y)};
  return mesh;
}

void count_hexes(benchmark::State& state, const HexMesh& mesh) {
  state.SetItemsProcessed(static_cast<long>(state.iterations() * mesh.num_hexes()));
}

void scaled_jacobians(benchmark::State& state) {
  const HexMesh mesh = distorted_box(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(compute_scaled_jacobians(mesh).size());
  count_hexes(state, mesh);
}
BENCHMARK(scaled_jacobians)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

void quality_summary(benchmark::State& state) {
  const HexMesh mesh = distorted_box(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(summarize_quality(mesh).total_volume);
  count_hexes(state, mesh);
}
BENCHMARK(quality_summary)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

void topology(benchmark::State& state) {
  const HexMesh mesh = distorted_box(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(check_topology(mesh).num_components);
  count_hexes(state, mesh);
}
BENCHMARK(topology)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

void two_way_distance(benchmark::State& state) {
  HexMesh mesh = distorted_box(state.range(0));
  const SurfaceTree surface(boundary_triangles(mesh));
  for (Vec3& p : mesh.positions) p += 0.002 * surface.box().diagonal() * Vec3{1, 1, 1};
  for (auto _ : state) benchmark::DoNotOptimize(measure_distance(mesh, surface, {}).max_to_mesh);
  count_hexes(state, mesh);
}
BENCHMARK(two_way_distance)->Arg(30)->Arg(60)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace hexwright
