// A verdict in a few lines of text.
#include "verdict_text.h"

#include <fmt/format.h>

namespace hexwright::cli {

void print_verdict(const Verdict& verdict, Console& console) {
  const QualitySummary& q = verdict.quality;
  const TopologyReport& t = verdict.topology;
  console.print(fmt::format("  scaled Jacobian  min {:.3f}, average {:.3f}; {} inverted of {}",
                            q.min_scaled_jacobian, q.avg_scaled_jacobian, q.num_inverted,
                            q.num_hexes));
  if (q.num_not_positive + q.num_undecided > 0)
    console.print(fmt::format("  inside elements  {} not positive, {} undecided (Bezier test)",
                              q.num_not_positive, q.num_undecided));
  console.print(fmt::format("  topology         {} component{}, genus {}, {}", t.num_components,
                            t.num_components == 1 ? "" : "s", t.genus(),
                            t.is_valid() ? "closed manifold boundary" : "not valid"));
  if (verdict.distance) {
    const SurfaceDistance& d = *verdict.distance;
    console.print(fmt::format(
        "  distance         max {:.3f}%, mean {:.4f}% of the diagonal (to mesh {:.3f}%, to surface "
        "{:.3f}%)",
        100 * d.max_two_way(), 100 * d.mean_two_way(), 100 * d.max_to_mesh,
        100 * d.max_to_surface));
  }
  if (verdict.features && (verdict.features->total_length > 0 || verdict.features->num_corners > 0))
    console.print(fmt::format("  sharp features   {:.1f}% of the length, {} of {} corners",
                              100 * verdict.features->length_share,
                              verdict.features->num_corners_recovered,
                              verdict.features->num_corners));
}

}  // namespace hexwright::cli
