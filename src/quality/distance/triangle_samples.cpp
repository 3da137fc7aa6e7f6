#include "quality/distance/triangle_samples.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

// Rows parallel to the longest edge (row 0 is that edge, the last one the opposite vertex). The
// triangle's corners belong to the vertices' samples, not to the rows.
class Rows {
 public:
  Rows(const std::array<Vec3, 3>& p, double spacing) : spacing_(spacing) {
    double longest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = hexwright::distance(p[k], p[(k + 1) % 3]);
      if (length > longest) {
        longest = length;
        first_ = k;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) p_[k] = p[(first_ + k) % 3];
    length_ = longest;
    area_ = 0.5 * norm(cross(p_[1] - p_[0], p_[2] - p_[0]));
    const double height = longest > 0 ? 2 * area_ / longest : 0;
    num_rows_ = std::max<std::size_t>(1, count_steps(height));
  }

  std::size_t num_rows() const { return num_rows_; }  // without the opposite vertex
  std::size_t num_intervals(std::size_t row) const {
    return std::max<std::size_t>(1, count_steps(length_ * (1 - fraction(row))));
  }
  // Samples of a row; row 0 lacks its two ends, which are corners.
  std::size_t num_samples(std::size_t row) const {
    return row == 0 ? num_intervals(0) - 1 : num_intervals(row) + 1;
  }
  std::size_t num_samples() const {
    std::size_t count = 0;
    for (std::size_t row = 0; row < num_rows_; ++row) count += num_samples(row);
    return count;
  }

  Vec3 point(std::size_t row, std::size_t i) const {
    const double t = fraction(row);
    const double s =
        static_cast<double>(row == 0 ? i + 1 : i) / static_cast<double>(num_intervals(row));
    const Vec3 begin = p_[0] + t * (p_[2] - p_[0]);
    const Vec3 end = p_[1] + t * (p_[2] - p_[1]);
    return begin + s * (end - begin);
  }
  double weight(std::size_t row, std::size_t i) const {
    const std::size_t n = num_intervals(row);
    const bool is_end = row > 0 && (i == 0 || i == n);
    return row_weight(row) / static_cast<double>(n) * (is_end ? 0.5 : 1);
  }
  // Weight of each corner of the triangle, in its own order.
  std::array<double, 3> corner_weights() const {
    const double base = 0.5 * row_weight(0) / static_cast<double>(num_intervals(0));
    std::array<double, 3> weights{};
    weights[first_] = weights[(first_ + 1) % 3] = base;
    weights[(first_ + 2) % 3] = row_weight(num_rows_);
    return weights;
  }

 private:
  double fraction(std::size_t row) const {
    return static_cast<double>(row) / static_cast<double>(num_rows_);
  }
  std::size_t count_steps(double length) const {
    return static_cast<std::size_t>(std::ceil(length / spacing_ * (1 - 1e-12)));
  }
  // Integral of the row's hat function over the triangle, whose width shrinks linearly to zero.
  double row_weight(std::size_t row) const {
    const double unit = 2 * area_ / static_cast<double>(num_rows_);
    const double width = 1 - fraction(row);
    const double step = 1 / static_cast<double>(num_rows_);
    double weight = 0;
    if (row < num_rows_) weight += width / 3 + (width - step) / 6;
    if (row > 0) weight += width / 3 + (width + step) / 6;
    return weight * unit;
  }

  double spacing_;
  std::array<Vec3, 3> p_;  // p_[0] p_[1] is the longest edge
  std::size_t first_ = 0;  // corner of the triangle that is p_[0]
  double length_ = 0, area_ = 0;
  std::size_t num_rows_ = 1;
};

}  // namespace

/// Counts first, points on demand: a surface sampled finely needs no memory for its samples, and
/// any chunk can be visited alone.
TriangleSamples::TriangleSamples(const TriMesh& surface, double spacing)
    : surface_(surface), spacing_(spacing), offset_(surface.num_tris() + 1, 0) {
  std::vector<std::array<double, 3>> corner_weights(surface.num_tris());
  parallel_for(surface.num_tris(), [&](std::size_t t) {
    const Rows rows(surface.corners(TriId(t)), spacing);
    offset_[t + 1] = rows.num_samples();
    corner_weights[t] = rows.corner_weights();
  });
  IdVector<VertId, double> weight(surface.num_verts(), -1);  // -1: no triangle uses it
  for (TriId t : surface.tris.ids()) {
    offset_[t.index() + 1] += offset_[t.index()];
    for (std::size_t k = 0; k < 3; ++k) {
      double& w = weight[surface.tris[t][k]];
      w = std::max(w, 0.0) + corner_weights[t.index()][k];
    }
  }
  for (VertId v : weight.ids()) {
    if (weight[v] < 0) continue;
    used_verts_.push_back(v);
    vert_weight_.push_back(weight[v]);
  }
}

void TriangleSamples::visit(std::size_t begin, std::size_t end,
                            FunctionRef<void(const Vec3&, double)> visit) const {
  const std::size_t num_verts = used_verts_.size();
  for (std::size_t i = begin; i < std::min(end, num_verts); ++i)
    visit(surface_.positions[used_verts_[i]], vert_weight_[i]);
  if (end <= num_verts) return;
  begin = std::max(begin, num_verts) - num_verts;
  end -= num_verts;
  // The triangle that holds sample `begin` is the last one with an offset not beyond it.
  const auto next = std::upper_bound(offset_.begin(), offset_.end(), begin);
  std::size_t index = static_cast<std::size_t>(next - offset_.begin()) - 1;
  for (; index < surface_.num_tris() && offset_[index] < end; ++index) {
    const Rows rows(surface_.corners(TriId(index)), spacing_);
    std::size_t sample = offset_[index];
    for (std::size_t row = 0; row < rows.num_rows(); ++row) {
      const std::size_t count = rows.num_samples(row);
      const std::size_t first = std::max(begin, sample) - sample;
      for (std::size_t i = first; i < count && sample + i < end; ++i)
        visit(rows.point(row, i), rows.weight(row, i));
      sample += count;
    }
  }
}

}  // namespace hexwright
