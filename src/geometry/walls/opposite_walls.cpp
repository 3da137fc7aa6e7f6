// Distances to facing walls, inside and outside, at points spread over the surface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/shape_diameter.h"

#include "geometry/walls/ray_scene.h"

namespace hexwright {
namespace {

constexpr int kNumRays = 13;
constexpr double kHalfAngle = 36 * std::numbers::pi / 180;
constexpr double kFacing = -0.8;  ///< cosine between normals of opposite walls, at most
/// A gigabyte of results; more means that the spacing is not what the caller had in mind.
constexpr double kMaxSamples = 2e7;
/// Triangles that are sampled whatever their area, about.
constexpr std::size_t kMostObliged = 200'000;

/// Centroids of the pieces of a triangle bisected across its longest side until no side is longer
/// than twice the spacing (half a square of that size per piece at most, whatever the shape).
void sample_triangle(const std::array<Vec3, 3>& c, double spacing, std::vector<Vec3>& out) {
  int longest = 0;
  double length_sq = -1;
  for (int k = 0; k < 3; ++k) {
    const double d =
        norm_sq(c[static_cast<std::size_t>((k + 1) % 3)] - c[static_cast<std::size_t>(k)]);
    if (d <= length_sq) continue;
    length_sq = d;
    longest = k;
  }
  if (length_sq <= 4 * spacing * spacing) {
    out.push_back((c[0] + c[1] + c[2]) / 3);
    return;
  }
  const Vec3 a = c[static_cast<std::size_t>(longest)];
  const Vec3 b = c[static_cast<std::size_t>((longest + 1) % 3)];
  const Vec3 apex = c[static_cast<std::size_t>((longest + 2) % 3)];
  const Vec3 middle = (a + b) * 0.5;
  sample_triangle({a, middle, apex}, spacing, out);
  sample_triangle({middle, b, apex}, spacing, out);
}

/// About how many samples the spacing asks for; needles count by their length.
double estimate_samples(const TriMesh& unit, double spacing) {
  double sum = static_cast<double>(std::min(unit.num_tris(), kMostObliged));
  for (TriId t : unit.tris.ids()) {
    const auto c = unit.corners(t);
    const double longest =
        std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
    sum += norm(cross(c[1] - c[0], c[2] - c[0])) / (spacing * spacing) + longest / spacing;
  }
  return sum;
}

/// Chooses among the pieces of one triangle after the other so that a share of 1/spacing^2 of the
/// area is sampled, evenly, and every triangle at least once. Needles have many small pieces;
/// taking all would cost far more rays than their area is worth. Of more than kMostObliged
/// triangles those within one piece are sampled in turns: their neighbours speak for them.
class SampleThinner {
 public:
  SampleThinner(double spacing, std::size_t num_tris)
      : area_per_sample_(spacing * spacing), turn_(num_tris / kMostObliged + 1) {}

  /// Appends the chosen ones of equal-sized pieces of a triangle with the given area.
  void choose(std::span<const Vec3> pieces, double area, std::vector<Vec3>& out) {
    const std::size_t before = out.size();
    for (const Vec3& piece : pieces) {
      carry_ += area / static_cast<double>(pieces.size()) / area_per_sample_;
      if (carry_ < 1) continue;
      carry_ -= std::floor(carry_);
      out.push_back(piece);
    }
    if (out.size() > before) return;
    const std::size_t count = next_++;
    if (pieces.size() == 1 && count % turn_ != 0) return;
    out.push_back(pieces[count % pieces.size()]);
  }

 private:
  double area_per_sample_;
  std::size_t turn_;      ///< one of so many small triangles is sampled whatever its area
  double carry_ = 0;      ///< samples owed to the area so far
  std::size_t next_ = 0;  ///< spreads the obligatory samples of needles along them
};

/// Least length x cosine over the rays that meet a wall facing back.
double least_width(const SurfaceTree& tree, const std::vector<ConeRay>& cone, const Vec3& from,
                   TriId tri, const Vec3& axis) {
  const AxisFrame frame(axis);
  double least = std::numeric_limits<double>::infinity();
  for (const ConeRay& ray : cone) {
    const auto hit = first_wall(tree, from, tri, frame.to_world(ray.direction));
    if (hit && dot(tree.normal(hit->tri), tree.normal(tri)) < kFacing)
      least = std::min(least, hit->length * ray.direction.z);
  }
  return least;
}

}  // namespace

std::vector<WallSample> sample_opposite_walls(const SurfaceTree& tree, double spacing,
                                              const Context& context) {
  const auto watch = context.watch();
  const TriMesh& surface = tree.surface();
  if (!(spacing > 0)) throw Error(ErrorCode::BadArgument, "the sample spacing must be positive");
  if (estimate_samples(surface, spacing) > kMaxSamples)
    throw Error(ErrorCode::OutOfResources,
                "the sample spacing asks for more than 20 million samples; use a coarser one");
  std::vector<Vec3> points;
  std::vector<TriId> tris;
  SampleThinner thinner(spacing, surface.num_tris());
  std::vector<Vec3> pieces;
  for (TriId t : surface.tris.ids()) {
    if (tree.normal(t) == Vec3{}) continue;
    const auto c = surface.corners(t);
    pieces.clear();
    sample_triangle(c, spacing, pieces);
    thinner.choose(pieces, norm(cross(c[1] - c[0], c[2] - c[0])) / 2, points);
    tris.resize(points.size(), t);
  }
  auto cone = spread_cone(kNumRays - 1, kHalfAngle);
  cone.push_back({{0, 0, 1}, 0});  // straight across: between near side walls no other gets through
  std::vector<WallSample> samples(points.size());
  parallel_chunks(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    context.check_cancelled();
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& n = tree.normal(tris[i]);
      samples[i] = {points[i], tris[i], least_width(tree, cone, points[i], tris[i], -n),
                    least_width(tree, cone, points[i], tris[i], n)};
    }
  });
  return samples;
}

std::vector<WallSample> sample_opposite_walls(const TriMesh& surface, double spacing,
                                              const Context& context) {
  const Similarity frame = compute_unit_frame(surface);
  auto samples = sample_opposite_walls(SurfaceTree(to_unit(surface, frame)),
                                       frame.length_to_unit(spacing), context);
  for (WallSample& sample : samples) sample.to_world(frame);
  return samples;
}

}  // namespace hexwright
