// Queries on a wavy sphere of 8 x 4^depth triangles, at points beside the surface in the order of
// its triangles, as the fit asks for them.
#include <random>

#include <benchmark/benchmark.h>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/geometry/surface_tree.h"

namespace hexwright {
namespace {

void subdivide(TriMesh& out, const std::array<Vec3, 3>& c, int depth) {
  if (depth == 0) {
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = normalized(c[k]);
      tri[k] = out.positions.push_back(p * (1 + 0.1 * std::sin(9 * p.x) * std::cos(7 * p.y)));
    }
    out.tris.push_back(tri);
    return;
  }
  const Vec3 m[3] = {(c[0] + c[1]) * 0.5, (c[1] + c[2]) * 0.5, (c[2] + c[0]) * 0.5};
  subdivide(out, {c[0], m[0], m[2]}, depth - 1);
  subdivide(out, {m[0], c[1], m[1]}, depth - 1);
  subdivide(out, {m[2], m[1], c[2]}, depth - 1);
  subdivide(out, {m[0], m[1], m[2]}, depth - 1);
}

TriMesh wavy_sphere(long depth) {
  TriMesh soup;
  for (double x : {1.0, -1.0})
    for (double y : {1.0, -1.0})
      for (double z : {1.0, -1.0}) {
        const Vec3 a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
        if (x * y * z > 0)
          subdivide(soup, {a, b, c}, static_cast<int>(depth));
        else
          subdivide(soup, {a, c, b}, static_cast<int>(depth));
      }
  return prepare_surface(soup, {}).mesh;
}

std::vector<Vec3> points_beside(const TriMesh& surface, double offset) {
  std::mt19937_64 random(1);
  const auto one = [&] { return 2 * double(random() >> 11) / double(1ull << 53) - 1; };
  std::vector<Vec3> points;
  for (TriId t : surface.tris.ids())
    points.push_back(surface.corners(t)[0] + Vec3{one(), one(), one()} * offset);
  return points;
}

void closest_point(benchmark::State& state) {
  const SurfaceTree tree(wavy_sphere(state.range(0)));
  const auto points = points_beside(tree.surface(), double(state.range(1)) * 1e-3);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(tree.closest(points[i++ % points.size()]));
}

void closest_point_by_normal(benchmark::State& state) {
  const SurfaceTree tree(wavy_sphere(state.range(0)));
  const auto points = points_beside(tree.surface(), double(state.range(1)) * 1e-3);
  ClosestFilter filter;
  filter.min_cosine = -0.2;
  std::size_t i = 0;
  for (auto _ : state) {
    const Vec3& p = points[i++ % points.size()];
    filter.normal = normalized(p);
    benchmark::DoNotOptimize(tree.closest(p, filter));
  }
}

void winding_number(benchmark::State& state) {
  const SurfaceTree tree(wavy_sphere(state.range(0)));
  const auto points = points_beside(tree.surface(), double(state.range(1)) * 1e-3);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(tree.winding_number(points[i++ % points.size()]));
}

void build_tree(benchmark::State& state) {
  const TriMesh surface = wavy_sphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(SurfaceTree(surface).box());
  state.SetItemsProcessed(state.iterations() * static_cast<long>(surface.num_tris()));
}

void prepare(benchmark::State& state) {
  const TriMesh surface = wavy_sphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(prepare_surface(surface, {}).mesh.num_tris());
  state.SetItemsProcessed(state.iterations() * static_cast<long>(surface.num_tris()));
}

void features(benchmark::State& state) {
  const TriMesh surface = wavy_sphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(extract_features(surface, {}).total_length());
  state.SetItemsProcessed(state.iterations() * static_cast<long>(surface.num_tris()));
}

void opposite_walls(benchmark::State& state) {
  const TriMesh surface = wavy_sphere(state.range(0));
  std::size_t num_samples = 0;
  for (auto _ : state) num_samples += sample_opposite_walls(surface, 0.03, {}).size();
  state.SetItemsProcessed(static_cast<long>(num_samples));
}

// Arguments: depth, offset from the surface in thousandths of the radius.
BENCHMARK(closest_point)->ArgsProduct({{4, 6}, {1, 20, 100}});
BENCHMARK(closest_point_by_normal)->ArgsProduct({{6}, {1, 20, 100}});
BENCHMARK(winding_number)->ArgsProduct({{4, 6}, {20, 100}});
BENCHMARK(build_tree)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(prepare)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(features)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(opposite_walls)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hexwright
