// Pieces of a curve that wind are cut in three until they do not.
#include "fit/curves/curve_waypoints.h"

namespace hexwright::fitting {
namespace {

constexpr double kWindingRatio = 1.6;  // of arc to chord, from which a piece is cut
constexpr double kShortPiece = 9;      // edge lengths below which no piece is cut
constexpr int kMaxDepth = 7;

class Cutter {
 public:
  Cutter(const TriMesh& surface, const FeatureCurve& curve, double edge_length)
      : surface_(surface), curve_(curve), edge_length_(edge_length) {}

  std::vector<double> run() {
    const bool is_loop = curve_.verts.front() == curve_.verts.back();
    if (is_loop || winds(0, curve_.length()))
      cut(0, curve_.length(), 1);
    else
      arcs_.push_back(curve_.length());
    arcs_.back() = curve_.length();
    return std::move(arcs_);
  }

 private:
  bool winds(double lo, double hi) const {
    const Vec3 a = point_at_arc(surface_, curve_, lo).point;
    const Vec3 b = point_at_arc(surface_, curve_, hi).point;
    return hi - lo > kWindingRatio * distance(a, b);
  }

  void cut(double lo, double hi, int depth) {
    for (int k = 0; k < 3; ++k) {
      const double a = lo + (hi - lo) * k / 3, b = lo + (hi - lo) * (k + 1) / 3;
      if (depth < kMaxDepth && b - a > kShortPiece * edge_length_ && winds(a, b))
        cut(a, b, depth + 1);
      else
        arcs_.push_back(b);
    }
  }

  const TriMesh& surface_;
  const FeatureCurve& curve_;
  double edge_length_;
  std::vector<double> arcs_{0};
};

}  // namespace

std::vector<double> find_waypoint_arcs(const TriMesh& surface, const FeatureCurve& curve,
                                       double edge_length) {
  return Cutter(surface, curve, edge_length).run();
}

}  // namespace hexwright::fitting
