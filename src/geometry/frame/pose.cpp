// Normals are binned as lines on a cube map; peaks of the bins are the candidates for axes.
//
// The score of a frame is the area whose normals lie within three degrees of an axis, less the
// farther they are from it: a part turned by two degrees must not pass for one along its axes.
#include "hexwright/geometry/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hexwright {
namespace {

// Angles are compared by their sines: so small that the sine stands for the angle.
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kReach = 3 * kDegree;  // of a cluster of normals, and of an axis
// With less than a quarter of the area along them, axes gained nothing on the parts tried: fewer
// hexes at times, but a lower least and average scaled Jacobian.
constexpr double kLeastScore = 0.25, kLeastGain = 0.1;
constexpr std::size_t kNumFirst = 10, kNumSecond = 24;  // clusters tried as axes
constexpr double kLeastAcross = 0.5;  // sine of the least angle between two clusters of a frame
/// Each fit of the frame looks at faces nearer to its axes: what is curved or tilted drops out.
constexpr double kFitReaches[] = {3 * kDegree, 1 * kDegree, 0.2 * kDegree, 0.05 * kDegree};
constexpr double kLeastKept = 0.5;  // share of the area that a nearer look must keep

struct Facet {
  Vec3 normal;  // unit, sign arbitrary
  double area = 0;
};

std::vector<Facet> facets_of(const TriMesh& surface) {
  std::vector<Facet> facets;
  facets.reserve(surface.num_tris());
  for (TriId t : surface.tris.ids()) {
    const auto [a, b, c] = surface.corners(t);
    const Vec3 n = cross(b - a, c - a);
    const double area = norm(n);
    if (area > 0) facets.push_back({n / area, area});
  }
  return facets;
}

/// Lines of direction on a cube map: a cell of about three degrees holds the facets of one.
class LineBins {
 public:
  explicit LineBins(const std::vector<Facet>& facets) : bins_(3 * kSide * kSide) {
    for (const Facet& f : facets) {
      const Vec3 n = canonical(f.normal);
      Facet& bin = bins_[index_of(n)];
      bin.normal += n * f.area;
      bin.area += f.area;
    }
    std::erase_if(bins_, [](const Facet& bin) { return bin.area <= 0; });
    for (Facet& bin : bins_) bin.normal = normalized(bin.normal);
    std::stable_sort(bins_.begin(), bins_.end(),
                     [](const Facet& a, const Facet& b) { return a.area > b.area; });
  }

  const std::vector<Facet>& by_area() const { return bins_; }

  /// Clusters of bins around the largest of those left, largest first.
  std::vector<Vec3> clusters(std::size_t count) const {
    std::vector<char> is_taken(bins_.size(), 0);
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < bins_.size() && out.size() < count; ++i) {
      if (is_taken[i]) continue;
      Vec3 sum;
      for (std::size_t j = i; j < bins_.size(); ++j) {
        if (is_taken[j] || norm(cross(bins_[i].normal, bins_[j].normal)) > kReach) continue;
        is_taken[j] = 1;
        const bool is_opposite = dot(bins_[i].normal, bins_[j].normal) < 0;
        sum += bins_[j].normal * (is_opposite ? -bins_[j].area : bins_[j].area);
      }
      out.push_back(normalized(sum));
    }
    return out;
  }

 private:
  static constexpr int kSide = 60;

  /// The sign that makes the largest component positive.
  static Vec3 canonical(const Vec3& n) { return n[largest_axis(n)] < 0 ? -n : n; }
  static int largest_axis(const Vec3& n) {
    int axis = 0;
    for (int a = 1; a < 3; ++a)
      if (std::abs(n[a]) > std::abs(n[axis])) axis = a;
    return axis;
  }
  static std::size_t index_of(const Vec3& n) {
    const int axis = largest_axis(n);
    const auto cell = [&](int a) {
      const double t = 0.5 + 0.5 * n[a % 3] / n[axis];
      return std::min(static_cast<int>(t * kSide), kSide - 1);
    };
    return static_cast<std::size_t>((axis * kSide + cell(axis + 1)) * kSide + cell(axis + 2));
  }

  std::vector<Facet> bins_;
};

/// Sine of the angle between a facet's normal line and the nearest axis, and which axis that is.
struct NearestAxis {
  int axis = 0;
  double sine = 0;
};
NearestAxis nearest_axis(const Rotation& frame, const Vec3& normal) {
  NearestAxis best{0, 2};
  for (int a = 0; a < 3; ++a) {
    const double sine = norm(cross(frame.axes[a], normal));
    if (sine < best.sine) best = {a, sine};
  }
  return best;
}

double score_of(const Rotation& frame, const std::vector<Facet>& facets) {
  double score = 0, total = 0;
  for (const Facet& f : facets) {
    total += f.area;
    score += f.area * std::max(0.0, 1 - nearest_axis(frame, f.normal).sine / kReach);
  }
  return total > 0 ? score / total : 0;
}

Rotation frame_from(const Vec3& first, const Vec3& second) {
  Rotation frame;
  frame.axes[0] = normalized(first);
  frame.axes[1] = normalized(second - frame.axes[0] * dot(second, frame.axes[0]));
  frame.axes[2] = cross(frame.axes[0], frame.axes[1]);
  return frame;
}

/// Solves the symmetric positive definite system with rows m by Cramer's rule; zero when singular.
Vec3 solve(const std::array<Vec3, 3>& m, const Vec3& rhs) {
  const double d = det(m[0], m[1], m[2]);
  if (!(std::abs(d) > 1e-12)) return {};
  return Vec3{det(rhs, m[1], m[2]), det(m[0], rhs, m[2]), det(m[0], m[1], rhs)} / d;
}

/// One Gauss-Newton step of the least-squares fit of the axes to the normals near them: turning by
/// w takes the axis a to a + w x a, which should meet the normal n. Absent when too little is near.
struct FrameFit {
  Rotation frame;
  double area = 0;
};
FrameFit fit_axes(const Rotation& frame, const std::vector<Facet>& facets, double reach) {
  std::array<Vec3, 3> m{};
  Vec3 rhs;
  FrameFit fit{frame, 0};
  for (const Facet& f : facets) {
    const NearestAxis near = nearest_axis(frame, f.normal);
    if (near.sine > reach) continue;
    const Vec3& a = frame.axes[near.axis];
    const Vec3 n = dot(a, f.normal) < 0 ? -f.normal : f.normal;
    fit.area += f.area;
    rhs += cross(a, n) * f.area;
    for (int i = 0; i < 3; ++i) {
      Vec3 row = a * -a[i];
      row[i] += 1;
      m[i] += row * f.area;
    }
  }
  if (!(fit.area > 0)) return fit;
  for (Vec3& row : m) row = row / fit.area;
  const Vec3 w = solve(m, rhs / fit.area);
  fit.frame =
      frame_from(frame.axes[0] + cross(w, frame.axes[0]), frame.axes[1] + cross(w, frame.axes[1]));
  return fit;
}

Rotation refine(Rotation frame, const std::vector<Facet>& facets) {
  constexpr int kSteps = 3;
  double area = 0;
  for (const double reach : kFitReaches) {
    const Rotation before = frame;
    for (int step = 0; step < kSteps; ++step) {
      const FrameFit fit = fit_axes(frame, facets, reach);
      if (fit.area < kLeastKept * area) return before;
      if (step == 0) area = std::max(fit.area, kLeastKept * area);
      frame = fit.frame;
    }
  }
  return frame;
}

/// The same frame with the order and signs of its axes that turn the part least.
Rotation nearest_to_given(const Rotation& frame) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  Rotation best;
  double best_trace = -4;
  for (const auto& order : kOrders) {
    Rotation turned;
    double trace = 0;
    for (int a = 0; a < 3; ++a) {
      const Vec3& axis = frame.axes[order[a]];
      turned.axes[a] = axis[a] < 0 ? -axis : axis;
      trace += turned.axes[a][a];
    }
    if (det(turned.axes[0], turned.axes[1], turned.axes[2]) < 0) {
      // One sign must differ: that of the axis that is farthest from its own.
      int worst = 0;
      for (int a = 1; a < 3; ++a)
        if (turned.axes[a][a] < turned.axes[worst][worst]) worst = a;
      trace -= 2 * turned.axes[worst][worst];
      turned.axes[worst] = -turned.axes[worst];
    }
    if (trace > best_trace + 1e-9) best = turned, best_trace = trace;
  }
  return best;
}

/// Gives equal coordinates along `axis` to vertices of faces across it that lie in one plane.
void flatten_planes(TriMesh& mesh, int axis, double tolerance) {
  constexpr double kAcross = 1 * kDegree;
  std::vector<std::pair<double, VertId>> coords;
  for (TriId t : mesh.tris.ids()) {
    const auto corners = mesh.corners(t);
    const Vec3 n = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto [lo, hi] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    if (hi - lo > tolerance || 1 - n[axis] * n[axis] > kAcross * kAcross) continue;
    for (VertId v : mesh.tris[t]) coords.emplace_back(mesh.positions[v][axis], v);
  }
  std::sort(coords.begin(), coords.end());
  for (std::size_t first = 0; first < coords.size();) {
    std::size_t end = first;
    while (end < coords.size() && coords[end].first - coords[first].first <= tolerance) ++end;
    const double plane = 0.5 * (coords[first].first + coords[end - 1].first);
    for (; first < end; ++first) mesh.positions[coords[first].second][axis] = plane;
  }
}

}  // namespace

Rotation find_pose(const TriMesh& surface) {
  const std::vector<Facet> facets = facets_of(surface);
  const LineBins bins(facets);
  const std::vector<Vec3> clusters = bins.clusters(kNumSecond);
  Rotation best;
  const double given_score = score_of(best, bins.by_area());
  double best_score = given_score;
  for (std::size_t i = 0; i < std::min(kNumFirst, clusters.size()); ++i) {
    for (const Vec3& second : clusters) {
      if (norm(cross(clusters[i], second)) < kLeastAcross) continue;
      const Rotation frame = frame_from(clusters[i], second);
      const double score = score_of(frame, bins.by_area());
      if (score > best_score) best = frame, best_score = score;
    }
  }
  if (best_score < given_score + kLeastGain || best_score < kLeastScore) return {};
  best = refine(best, facets);
  const double score = score_of(best, facets);
  if (score < score_of(Rotation{}, facets) + kLeastGain || score < kLeastScore) return {};
  return nearest_to_given(best);
}

TriMesh turn_surface(const TriMesh& surface, const Rotation& pose, double tolerance) {
  TriMesh turned = surface;
  if (pose.is_identity()) return turned;
  for (Vec3& p : turned.positions) p = pose.apply(p);
  for (int axis = 0; axis < 3; ++axis) flatten_planes(turned, axis, tolerance);
  return turned;
}

}  // namespace hexwright
