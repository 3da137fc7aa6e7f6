// How densely an axis is cut follows how long the object is along it: for every thin layer of the
// polycube across the axis, the length that all but a tenth of the layer stays below. Candidates of
// several spacings are priced by the cells that the map's tets would need, one by one, without
// making a grid.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "polycube/lattice/axis_scales.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {
namespace {

constexpr double kLayersPerExtent = 256;
constexpr double kShareBelow = 0.9;  // of a layer's volume
// How much of the measured density a lattice follows.
constexpr double kFollow[] = {1, 0.5, 0};
constexpr int kStepsPerLevel = 4, kSpacings = 25;  // spacings tried: 25, four per factor of two
constexpr std::size_t kMostSamples = 20000;        // tets that candidates are priced with
// A cell off the commonest level counts that much more: changes of level cost cells in the
// completion and hexes in the dual mesh.
constexpr double kTransition = 0.6;
constexpr double kNearlyEqual = 1.1;  // costs

// What a tet says of the map: the object's vector per unit along each axis of the polycube.
struct MapSample {
  Vec3 center;  // in the polycube
  std::array<Vec3, 3> along;
  double volume = 0;  // of the polycube that it stands for
  double limit = 0;   // longest edge wanted there
};

bool map_of_tet(const TetMesh& object, const TetMesh& polycube, TetId t, MapSample& sample) {
  const auto p = tet_corners(polycube, t), q = tet_corners(object, t);
  const double volume = tet_det(p);
  if (!(volume > 0)) return false;
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3 of_a = cross(b, c) / volume, of_b = cross(c, a) / volume, of_c = cross(a, b) / volume;
  for (int axis = 0; axis < 3; ++axis)
    sample.along[static_cast<std::size_t>(axis)] =
        (q[1] - q[0]) * of_a[axis] + (q[2] - q[0]) * of_b[axis] + (q[3] - q[0]) * of_c[axis];
  sample.center = (p[0] + p[1] + p[2] + p[3]) * 0.25;
  sample.volume = volume / 6;
  return true;
}

// The layers of one axis: their borders, planes among them, and how long the object is in each per
// unit of the polycube.
class Layers {
 public:
  Layers(const std::vector<double>& planes, double thickness) {
    borders_ = {planes.front()};
    for (std::size_t i = 1; i < planes.size(); ++i) {
      const double low = planes[i - 1], width = planes[i] - low;
      const int count = std::max(1, static_cast<int>(std::lround(width / thickness)));
      for (int k = 1; k < count; ++k) borders_.push_back(low + width * k / count);
      borders_.push_back(planes[i]);
    }
    histogram_.resize(borders_.size() - 1);
    for (auto& h : histogram_) h.fill(0);
  }

  // A tet counts in all layers it reaches into, with its volume shared evenly by thickness.
  void add(double low, double high, double volume, double length) {
    const std::size_t bucket = bucket_of(length);
    for (std::size_t i = layer_at(low); i < histogram_.size() && borders_[i] < high; ++i) {
      const double part = std::min(high, borders_[i + 1]) - std::max(low, borders_[i]);
      if (part > 0) histogram_[i][bucket] += volume * part / (high - low);
    }
  }

  // Of every layer; where it holds nothing, that of the layer before.
  std::vector<double> lengths() const {
    std::vector<double> result;
    for (const auto& h : histogram_) {
      const double total = std::accumulate(h.begin(), h.end(), 0.0);
      double below = 0;
      std::size_t k = 0;
      while (k + 1 < h.size() && (below += h[k]) < kShareBelow * total) ++k;
      result.push_back(total > 0 ? length_of(k) : result.empty() ? 1 : result.back());
    }
    return result;
  }
  const std::vector<double>& borders() const { return borders_; }

 private:
  // Logarithmic buckets, eight per factor of two, around lengths of one.
  static constexpr int kPerOctave = 8, kNumBuckets = 512;
  static std::size_t bucket_of(double length) {
    const double k = kPerOctave * std::log2(std::max(length, 1e-9)) + kNumBuckets / 2.0;
    return static_cast<std::size_t>(std::clamp(k, 0.0, kNumBuckets - 1.0));
  }
  static double length_of(std::size_t bucket) {
    return std::exp2((static_cast<double>(bucket) + 0.5 - kNumBuckets / 2.0) / kPerOctave);
  }
  std::size_t layer_at(double x) const {
    const auto above = std::upper_bound(borders_.begin(), borders_.end(), x) - borders_.begin();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - 1, 0));
  }

  std::vector<double> borders_;
  std::vector<std::array<double, kNumBuckets>> histogram_;
};

// The density of every axis, relative to its mean over all, at the layers' borders.
class Densities {
 public:
  Densities(const AxisPlanes& planes, const TetMesh& object, const TetMesh& polycube)
      : planes_(planes) {
    double extent = 0;
    for (const auto& p : planes) extent = std::max(extent, p.back() - p.front());
    for (const auto& p : planes) layers_.emplace_back(p, extent / kLayersPerExtent);
    MapSample sample;
    for (TetId t : polycube.tets.ids()) {
      if (!map_of_tet(object, polycube, t, sample)) continue;
      Box3 box;
      for (const Vec3& p : tet_corners(polycube, t)) box.extend(p);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(axis);
        layers_[axis].add(box.lo[a], box.hi[a], sample.volume, norm(sample.along[axis]));
      }
    }
    double sum = 0, width = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lengths_[axis] = layers_[axis].lengths();
      const auto& x = layers_[axis].borders();
      for (std::size_t i = 0; i + 1 < x.size(); ++i) sum += lengths_[axis][i] * (x[i + 1] - x[i]);
      width += x.back() - x.front();
    }
    for (auto& lengths : lengths_)
      for (double& length : lengths) length /= sum / width;
  }

  // `follow` 0 is even.
  AxisScales scales(double spacing, double follow) const {
    AxisScales result;
    for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = scale(axis, spacing, follow);
    return result;
  }

 private:
  // Between two planes the integral of the density is rounded to a whole number of cubes.
  AxisScale scale(std::size_t axis, double spacing, double follow) const {
    const auto& x = layers_[axis].borders();
    AxisScale result{{x.front()}, {0}};
    std::size_t i = 0;
    for (std::size_t p = 1; p < planes_[axis].size(); ++p) {
      const double base = result.to.back();
      const std::size_t first = result.from.size();
      double sum = 0;
      for (; i + 1 < x.size() && x[i] < planes_[axis][p]; ++i) {
        sum += std::pow(lengths_[axis][i], follow) * (x[i + 1] - x[i]);
        result.from.push_back(x[i + 1]);
        result.to.push_back(sum);
      }
      const double cubes = std::max(1.0, std::round(sum / spacing));
      for (std::size_t k = first; k + 1 < result.to.size(); ++k)
        result.to[k] = base + cubes * (result.to[k] / sum);
      result.to.back() = base + cubes;
    }
    return result;
  }

  const AxisPlanes& planes_;
  std::vector<Layers> layers_;
  std::array<std::vector<double>, 3> lengths_;
};

std::vector<MapSample> sample_tets(const TetMesh& object, const TetMesh& polycube,
                                   const PolycubeOptions& options) {
  Box3 box;
  for (const Vec3& p : object.positions) box.extend(p);
  const double limit = options.max_stretch * box.diagonal();
  const std::size_t stride = 1 + polycube.num_tets() / kMostSamples;
  std::vector<MapSample> samples;
  for (std::size_t t = 0; t < polycube.num_tets(); t += stride) {
    MapSample sample;
    if (!map_of_tet(object, polycube, TetId(t), sample)) continue;
    sample.volume *= static_cast<double>(stride);
    sample.limit = limit;
    if (options.max_edge) {
      Vec3 center;
      for (VertId v : object.tets[TetId(t)]) center += object.positions[v] * 0.25;
      sample.limit = std::min(limit, options.max_edge(center));
    }
    samples.push_back(sample);
  }
  return samples;
}

struct Price {
  double cost = 0;
  int level = 0;  // that most cells are on
};

// Expected cells when every tet is cut to the level that its length asks for, however deep.
Price price(const AxisScales& scales, const std::vector<MapSample>& samples, int min_level) {
  constexpr int kDeepest = 20;
  std::array<double, kDeepest + 1> cells{};
  for (const MapSample& sample : samples) {
    double longest = 0, per_volume = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slope = scales[axis].slope(sample.center[static_cast<int>(axis)]);
      longest = std::max(longest, norm(sample.along[axis]) / slope);
      per_volume *= slope;
    }
    int level = min_level;
    while (level < kDeepest && longest > sample.limit * static_cast<double>(1 << level)) ++level;
    cells[static_cast<std::size_t>(level)] +=
        sample.volume * per_volume * static_cast<double>(1LL << (3 * level));
  }
  const auto most = std::max_element(cells.begin(), cells.end());
  const double total = std::accumulate(cells.begin(), cells.end(), 0.0);
  return {total + kTransition * (total - *most), static_cast<int>(most - cells.begin())};
}

// The coarsest of the cheapest. Where the greatest level stands against the criteria, only spacings
// that are whole levels finer than the coarsest one: the least cells are then as large as on that.
const ScaleCandidate& choose(const std::vector<ScaleCandidate>& tried,
                             const std::vector<int>& deepest, int max_level) {
  double least = std::numeric_limits<double>::infinity();
  for (const ScaleCandidate& c : tried) least = std::min(least, c.cost);
  const auto is_cheap = [&](const ScaleCandidate& c) { return c.cost <= kNearlyEqual * least; };
  auto best = std::find_if(tried.begin(), tried.end(), is_cheap);  // coarse ones come first
  if (deepest[static_cast<std::size_t>(best - tried.begin())] <= max_level) return *best;
  for (std::size_t i = 0; i < tried.size(); i += kStepsPerLevel)
    if (i == 0 || tried[i].cost < best->cost) best = tried.begin() + static_cast<std::ptrdiff_t>(i);
  return *best;
}

}  // namespace

std::vector<ScaleCandidate> suit_scales(const AxisPlanes& planes, const TetMesh& object,
                                        const TetMesh& polycube, const PolycubeOptions& options) {
  const double coarsest = geometric_spacing(planes);
  const Densities densities(planes, object, polycube);
  const auto samples = sample_tets(object, polycube, options);
  std::vector<ScaleCandidate> best;  // one per `follow`
  for (double follow : kFollow) {
    std::vector<ScaleCandidate> tried;
    std::vector<int>
        deepest;  // of each: the level from the coarsest spacing that most cells are on
    for (int step = 0; step < kSpacings; ++step) {
      ScaleCandidate c;
      c.spacing = coarsest * std::exp2(-static_cast<double>(step) / kStepsPerLevel);
      c.depth = (step + kStepsPerLevel / 2) / kStepsPerLevel;
      if (c.depth > options.max_level) break;
      c.scales = densities.scales(c.spacing, follow);
      if (step > 0 && !is_within_limit(c.scales)) break;
      const Price p = price(c.scales, samples, std::max(0, options.min_level - c.depth));
      c.cost = p.cost;
      deepest.push_back(c.depth + p.level);
      tried.push_back(std::move(c));
    }
    best.push_back(choose(tried, deepest, options.max_level));
  }
  // The even lattice stays last: nothing that was positive folds on it that would not on others.
  std::stable_sort(
      best.begin(), best.end() - 1,
      [](const ScaleCandidate& a, const ScaleCandidate& b) { return a.cost < b.cost; });
  if (best.back().cost <= best.front().cost) best.erase(best.begin(), best.end() - 1);
  return best;
}

}  // namespace hexwright::polycube
