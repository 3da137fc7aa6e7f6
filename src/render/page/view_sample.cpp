#include "render/page/view_sample.h"

#include <algorithm>
#include <numeric>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

constexpr std::size_t kNumWorst = 10'000;
// Off the middle by a little: meshes of symmetric parts have centres on the middle itself.
constexpr std::array<double, 3> kSlices = {0.2503, 0.5003, 0.7503};

Vec3 center_of(const HexMesh& mesh, HexId h) {
  Vec3 sum;
  for (const Vec3& p : mesh.corners(h)) sum += p;
  return sum / 8;
}

// Bit i of a hex: its centre lies beyond slice i (axis by axis).
using Sides = IdVector<HexId, std::uint16_t>;
Sides find_sides(const HexMesh& mesh) {
  const Box3 box = bounding_box(mesh);
  Sides sides(mesh.num_hexes(), 0);
  parallel_for(mesh.num_hexes(), [&](std::size_t i) {
    const Vec3 center = center_of(mesh, HexId(i));
    int bit = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const double share : kSlices) {
        const double plane = box.lo[axis] + share * box.extent()[axis];
        if (center[axis] > plane)
          sides[HexId(i)] = static_cast<std::uint16_t>(sides[HexId(i)] | 1 << bit);
        ++bit;
      }
  });
  return sides;
}

// The worst, ties by id.
void mark_worst(const IdVector<HexId, double>& values, std::size_t count,
                IdVector<HexId, char>& is_taken) {
  std::vector<std::int32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_worse = [&](std::int32_t a, std::int32_t b) {
    const double va = values[HexId(a)], vb = values[HexId(b)];
    return va != vb ? va < vb : a < b;
  };
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(order.begin(), end, order.end(), is_worse);
  std::for_each(order.begin(), end, [&](std::int32_t h) { is_taken[HexId(h)] = 1; });
}

}  // namespace

ViewSample choose_view_sample(const HexMesh& mesh, const HexNeighbors& adjacency,
                              const IdVector<HexId, double>& values, std::size_t max_whole) {
  ViewSample sample;
  sample.is_whole = mesh.num_hexes() <= max_whole;
  IdVector<HexId, char> is_taken(mesh.num_hexes(), sample.is_whole ? 1 : 0);
  if (!sample.is_whole) {
    sample.slices.assign(kSlices.begin(), kSlices.end());
    const Sides sides = find_sides(mesh);
    for (HexId h : mesh.hexes.ids()) {
      bool is_skin = false;
      for (HexId other : adjacency.neighbor[h]) {
        is_skin = is_skin || !other.is_valid();
        if (!other.is_valid() || sides[other] != sides[h]) is_taken[h] = 1;
      }
      sample.num_skin += is_skin ? 1 : 0;
    }
    sample.num_worst = std::min(kNumWorst, mesh.num_hexes());
    mark_worst(values, sample.num_worst, is_taken);
  }
  for (HexId h : mesh.hexes.ids())
    if (is_taken[h]) sample.hexes.push_back(h);
  return sample;
}

}  // namespace hexwright
