// Two-way sampled distance between a hex mesh's boundary and a surface.
//
// Based on: Cignoni, Rocchini, Scopigno, "Metro: measuring error on simplified surfaces", Computer
// Graphics Forum 17(2), 1998 (sampling).
// Differs: rows of samples parallel to a triangle's longest edge, so that needles cost their length
// and not its square; weights that integrate piecewise linear functions exactly.
#include "hexwright/quality/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hexwright/base/error.h"
#include "hexwright/base/function_ref.h"
#include "hexwright/base/parallel.h"
#include "hexwright/geometry/exposure.h"
#include "hexwright/geometry/surface_topology.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "quality/distance/bound_both_ways.h"
#include "quality/distance/nearby_queries.h"
#include "quality/distance/triangle_samples.h"

namespace hexwright {
namespace {

constexpr std::size_t kGrain = 1024;

/// Samples nearer than this share of the diagonal are not worth a test for the means.
constexpr double kTrustedDistance = 0.001;
/// Nor are those nearer than this for the maximum: beside an edge between wall and surface the two
/// cannot be told apart (bounds_solid_near).
constexpr double kRounding = 1e-4;

/// For the means, far samples this near to one that was tested, as a share of the diagonal, are
/// taken to be as that one: tests take long where the winding number does, on needles.
constexpr double kSameRadius = 0.004;

/// A boundary this many times as large as the surface is sampled relative to its own size.
constexpr double kFarLarger = 3;

/// What samples are measured to.
struct Reference {
  const SurfaceTree& tree;
  double hot_distance = 0;  // infinity when hot samples are not wanted
  // Says that a sample far from it is right to be there.
  FunctionRef<bool(const Vec3& p, double distance)> is_excused;
  bool has_excuses = false;     // whether to ask
  double trusted_distance = 0;  // up to here samples count in the means unasked,
  double rounding = 0;          // and up to here in the maximum
  double same_radius = 0;
};

/// Whether the winding number passes 1/2 nearer to the boundary's point p than any surface, at d:
/// there it closes a hole.
bool is_closing_hole(const SurfaceTree& boundary, const SurfaceTree& solid, const Vec3& p,
                     double d) {
  const auto at = boundary.closest(p);
  if (!at) return false;
  const Vec3 step = boundary.normal(at->tri) * (0.9 * d);
  return solid.is_inside(p - step) != solid.is_inside(p + step);
}

// What one chunk of samples finds; chunks are combined from left to right.
struct Partial {
  double max = -1;
  Vec3 worst;
  double weighted_sum = 0, weight = 0, excused_weight = 0;
  std::vector<Vec3> hot;
};

Partial combine(Partial a, const Partial& b) {
  if (b.max > a.max) {
    a.max = b.max;
    a.worst = b.worst;
  }
  a.weighted_sum += b.weighted_sum;
  a.weight += b.weight;
  a.excused_weight += b.excused_weight;
  a.hot.insert(a.hot.end(), b.hot.begin(), b.hot.end());
  return a;
}

// Measures samples that come in an order where neighbours are near, which bounds each search.
class SampleMeter {
 public:
  explicit SampleMeter(const Reference& reference)
      : reference_(reference), queries_(&reference.tree) {}

  /// Returns the distance, whether it counts or not.
  double add(const Vec3& p, double weight) {
    const auto hit = queries_.find(p);
    const double d = hit ? queries_.last_distance() : std::numeric_limits<double>::infinity();
    if (!counts(p, d)) {
      partial_.excused_weight += weight;
      return d;
    }
    if (d > partial_.max) {
      partial_.max = d;
      partial_.worst = p;
    }
    partial_.weighted_sum += weight * d;
    partial_.weight += weight;
    if (d > reference_.hot_distance) partial_.hot.push_back(p);
    return d;
  }
  const Partial& partial() const { return partial_; }
  TriId nearest() const { return queries_.nearest(); }  ///< to the last sample

 private:
  /// Whether a sample counts. What would be the largest so far, or a place to refine, is tested
  /// itself.
  bool counts(const Vec3& p, double d) {
    if (!reference_.has_excuses) return true;
    const bool matters =
        d > std::max(partial_.max, reference_.rounding) || d > reference_.hot_distance;
    if (!matters && d <= reference_.trusted_distance) return true;
    const bool is_near = last_tested_ && distance(p, *last_tested_) < reference_.same_radius;
    if (is_near && !matters) return last_counts_;
    last_tested_ = p;
    return last_counts_ = !reference_.is_excused(p, d);
  }

  const Reference& reference_;
  NearbyQueries queries_;
  Partial partial_;
  std::optional<Vec3> last_tested_;
  bool last_counts_ = true;
};

/// Fills what bounds ask of the vertices, when that is given.
Partial measure(const TriMesh& sampled, const Reference& reference, double spacing,
                SampledDirection* of_verts) {
  const TriangleSamples samples(sampled, spacing);
  const std::size_t num_verts = of_verts ? samples.used_verts().size() : 0;
  if (of_verts) {
    of_verts->vert_distance.assign(sampled.num_verts(), 0);
    of_verts->vert_nearest.assign(sampled.num_verts(), TriId());
  }
  Partial total = parallel_reduce(
      samples.size(), Partial{},
      [&](std::size_t begin, std::size_t end) {
        SampleMeter meter(reference);
        std::size_t at = begin;
        samples.visit(begin, end, [&](const Vec3& p, double weight) {
          const double d = meter.add(p, weight);
          if (at < num_verts) {
            const std::size_t v = samples.used_verts()[at].index();
            of_verts->vert_distance[v] = d;
            of_verts->vert_nearest[v] = meter.nearest();
          }
          ++at;
        });
        return meter.partial();
      },
      combine, kGrain);
  if (samples.size() == 0) total.max = std::numeric_limits<double>::infinity();
  return total;
}

/// But for rounding.
bool is_not_inside(const Box3& box, const Vec3& p) {
  const double room = 1e-7 * box.diagonal();
  for (int a = 0; a < 3; ++a)
    if (p[a] <= box.lo[a] + room || p[a] >= box.hi[a] - room) return true;
  return false;
}

/// Zero when every sample was excused.
double max_of(const Partial& p) { return p.weight > 0 || p.excused_weight == 0 ? p.max : 0; }
double mean_of(const Partial& p) { return p.weight > 0 ? p.weighted_sum / p.weight : max_of(p); }

void take_bounds(const BoundsBothWays& bounds, double diagonal, bool has_excuses,
                 SurfaceDistance& result) {
  result.max_to_mesh = bounds.to_mesh.lower / diagonal;
  result.max_to_surface = bounds.to_surface.lower / diagonal;
  result.worst_on_surface = bounds.to_mesh.worst;
  result.worst_on_mesh = bounds.to_surface.worst;
  result.upper = {bounds.to_mesh.upper / diagonal, bounds.to_surface.upper / diagonal, has_excuses};
}

}  // namespace

void SurfaceDistance::to_world(const Similarity& frame) {
  worst_on_surface = frame.to_world(worst_on_surface);
  worst_on_mesh = frame.to_world(worst_on_mesh);
  for (Vec3& p : hot) p = frame.to_world(p);
}

SurfaceDistance measure_distance(const HexMesh& mesh, const SurfaceTree& surface,
                                 const DistanceOptions& options) {
  if (!(options.spacing > 0) || !(options.hot_threshold >= 0))
    throw Error(ErrorCode::BadArgument,
                "the spacing of distance samples must be positive, the threshold not negative");
  const double diagonal = surface.diagonal();
  if (!(diagonal > 0))
    throw Error(ErrorCode::BadGeometry, "the surface has no extent to measure distances by");
  const double hot = options.hot_threshold > 0 ? options.hot_threshold * diagonal
                                               : std::numeric_limits<double>::infinity();
  const std::vector<std::array<VertId, 4>> quads = collect_judged_quads(mesh, options.quads);
  const SurfaceTree boundary(triangulate_quads(mesh, quads));
  const double spacing = options.spacing * diagonal;
  // A boundary many times as large as the surface (other units) would take that many samples
  // squared.
  const bool is_far_larger = boundary.box().diagonal() > kFarLarger * diagonal;
  const double boundary_spacing =
      is_far_larger ? options.spacing * boundary.box().diagonal() : spacing;
  const auto is_off_solid = [&](const Vec3& p, double) {
    if (options.domain && is_not_inside(*options.domain, p)) return true;
    if (!options.solid_only) return false;
    const auto at = surface.closest(p);
    return !at || !bounds_solid_near(surface, at->tri, p);
  };
  const auto closes_hole = [&](const Vec3& p, double d) {
    return is_closing_hole(boundary, surface, p, d);
  };
  const double trusted = kTrustedDistance * diagonal, rounding = kRounding * diagonal,
               radius = kSameRadius * diagonal;
  // The winding number of a closed surface changes on it only: there is no hole to close.
  const bool has_holes = options.solid_only && !is_oriented_cycle(surface.surface());
  const auto counts_on_surface = [&](const Vec3& p, double d) {
    return d <= rounding || !is_off_solid(p, d);
  };
  const auto counts_on_mesh = [&](const Vec3& p, double d) {
    return d <= rounding || !closes_hole(p, d);
  };
  SampledDirection on_surface{.counts = counts_on_surface,
                              .has_excuses = options.solid_only || options.domain};
  SampledDirection on_mesh{.counts = counts_on_mesh, .has_excuses = has_holes};
  // Patches have their middle from their sides.
  const bool has_face_nodes = mesh.mid_nodes && !mesh.mid_nodes->inner.empty();
  const bool is_bounded = options.bound_gap > 0 && !has_face_nodes;
  Partial to_mesh = measure(surface.surface(),
                            {boundary, hot, is_off_solid, options.solid_only || options.domain,
                             trusted, rounding, radius},
                            spacing, is_bounded ? &on_surface : nullptr);
  Partial to_surface =
      measure(boundary.surface(), {surface, hot, closes_hole, has_holes, trusted, rounding, radius},
              boundary_spacing, is_bounded ? &on_mesh : nullptr);

  SurfaceDistance result;
  result.max_to_mesh = max_of(to_mesh) / diagonal;
  result.mean_to_mesh = mean_of(to_mesh) / diagonal;
  result.worst_on_surface = to_mesh.worst;
  result.max_to_surface = max_of(to_surface) / diagonal;
  result.mean_to_surface = mean_of(to_surface) / diagonal;
  result.worst_on_mesh = to_surface.worst;
  const double all = to_mesh.weight + to_mesh.excused_weight;
  result.ignored_share = all > 0 ? to_mesh.excused_weight / all : 0;
  result.hot = std::move(to_mesh.hot);
  result.hot.insert(result.hot.end(), to_surface.hot.begin(), to_surface.hot.end());
  if (!is_bounded || quads.empty() || surface.surface().num_tris() == 0) return result;
  on_surface.max = max_of(to_mesh);
  on_surface.worst = to_mesh.worst;
  on_mesh.max = max_of(to_surface);
  on_mesh.worst = to_surface.worst;
  take_bounds(
      bound_both_ways({mesh, quads, surface, boundary, options.bound_gap * diagonal, 0.5 * spacing},
                      on_surface, on_mesh),
      diagonal, on_surface.has_excuses || on_mesh.has_excuses, result);
  return result;
}

std::vector<std::array<VertId, 4>> collect_judged_quads(const HexMesh& mesh, JudgedQuads which) {
  std::vector<std::array<VertId, 4>> quads;
  if (which == JudgedQuads::Labeled) {
    for (const LabeledQuad& quad : mesh.labels.quads)
      if (quad.patch.is_valid()) quads.push_back(quad.verts);
  } else {
    const HexNeighbors adjacency = compute_hex_neighbors(mesh);
    for (const HexFace& face : adjacency.boundary) quads.push_back(face_verts(mesh, face));
  }
  return quads;
}

namespace {

/// A quad of second order is divided until what a facet may be off is this share of the box.
constexpr double kFacetError = 1e-5;
constexpr double kMostDivisions = 8;

/// How far the sides of a quad are off their chords.
double sag_of(const QuadraticQuad& quad) {
  double sag = 0;
  for (std::size_t k = 0; k < 4; ++k)
    sag = std::max(sag, distance(quad[4 + k], 0.5 * quad[k] + 0.5 * quad[(k + 1) % 4]));
  return sag;
}

void append_facets(const QuadraticQuad& quad, int num_divisions, TriMesh& triangles) {
  const VertId first(triangles.num_verts());
  const int row = num_divisions + 1;
  for (int j = 0; j < row; ++j)
    for (int i = 0; i < row; ++i)
      triangles.positions.push_back(
          point_on(quad, double(i) / num_divisions, double(j) / num_divisions));
  for (int j = 0; j < num_divisions; ++j)
    for (int i = 0; i < num_divisions; ++i) {
      const int at = first.value() + j * row + i;
      const VertId a(at), b(at + 1), c(at + row + 1), d(at + row);
      triangles.tris.push_back({a, b, c});
      triangles.tris.push_back({a, c, d});
    }
}

/// The same of a mesh of second order: curved quads as many small facets.
TriMesh facet_curved_quads(const HexMesh& mesh, const std::vector<std::array<VertId, 4>>& quads) {
  TriMesh triangles;
  triangles.positions = mesh.positions;
  const EdgeTable edges(mesh);
  const double error = kFacetError * bounding_box(mesh).diagonal();
  for (const auto& verts : quads) {
    const QuadraticQuad quad = quadratic_quad(mesh, edges, verts);
    const double divisions = std::ceil(std::sqrt(sag_of(quad) / error));
    append_facets(quad, static_cast<int>(std::clamp(divisions, 2.0, kMostDivisions)), triangles);
  }
  return triangles;
}

}  // namespace

TriMesh triangulate_quads(const HexMesh& mesh, const std::vector<std::array<VertId, 4>>& quads) {
  if (mesh.mid_nodes) return facet_curved_quads(mesh, quads);
  TriMesh triangles;
  triangles.positions = mesh.positions;
  triangles.positions.reserve(mesh.num_verts() + quads.size());
  triangles.tris.reserve(4 * quads.size());
  for (const auto& quad : quads) {
    Vec3 center;
    for (VertId v : quad) center += mesh.positions[v] * 0.25;
    const VertId c = triangles.positions.push_back(center);
    for (std::size_t k = 0; k < 4; ++k) triangles.tris.push_back({quad[k], quad[(k + 1) % 4], c});
  }
  return triangles;
}

TriMesh boundary_triangles(const HexMesh& mesh) {
  return triangulate_quads(mesh, collect_judged_quads(mesh, JudgedQuads::Boundary));
}

}  // namespace hexwright
