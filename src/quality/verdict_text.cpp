// The human-readable report of a verdict.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hexwright/quality/verdict_json.h"

#include "base/words.h"

namespace hexwright {
namespace {

constexpr std::size_t kBarWidth = 40;

std::string line(const char* label, const std::string& text) {
  return fmt::format("  {:<10} {}\n", label, text);
}

/// What there is, then its shape; the genus only where the boundary is a manifold and has one.
std::string topology_lines(const Verdict& verdict) {
  const TopologyReport& t = verdict.topology;
  std::string text =
      line("mesh", fmt::format("{}, {}, {}", counted(t.num_hexes, "hex", "hexes"),
                               counted(t.num_verts, "vertex", "vertices"),
                               counted(t.num_boundary_quads, "boundary quad", "boundary quads")));
  std::string shape =
      fmt::format("{}, {}", counted(t.num_components, "component", "components"),
                  counted(t.num_boundary_components, "boundary surface", "boundary surfaces"));
  if (t.is_valid()) shape += fmt::format(", genus {}; conforming and manifold", t.genus());
  if (t.num_contact_verts > 0)
    shape += fmt::format("; {} on faces of another body",
                         counted(t.num_contact_verts, "vertex", "vertices"));
  text += line("topology", shape);
  if (verdict.has_other_topology && t.is_valid())
    text +=
        line("", fmt::format("NOT the surface's: it has {} and genus {}",
                             counted(verdict.surface->num_components, "component", "components"),
                             verdict.surface->genus()));
  return text;
}

/// Unproven hexes are counted even when no corner is inverted: solvers integrate inside.
std::string quality_lines(const QualitySummary& q) {
  if (q.num_hexes == 0) return {};
  std::string text = line(
      "quality", fmt::format("scaled Jacobian: least {:.4f} (hex {}), average {:.4f}",
                             q.min_scaled_jacobian, q.worst_hex.value(), q.avg_scaled_jacobian));
  const std::size_t num_unproven = q.num_not_positive + q.num_undecided;
  text +=
      line("", num_unproven == 0
                   ? "0 inverted; the Jacobian is proven positive inside every hex"
                   : fmt::format("{} inverted; the Jacobian is not proven positive inside {}",
                                 grouped(q.num_inverted), counted(num_unproven, "hex", "hexes")));
  return text;
}

std::string second_order_lines(const SecondOrderQuality& q) {
  const std::size_t num_unproven = q.num_not_positive + q.num_undecided;
  return line("order 2", fmt::format("{}; least share of the mean Jacobian {:.4f} (hex {})",
                                     counted(q.num_curved, "curved hex", "curved hexes"),
                                     q.min_jacobian_share, q.worst_hex.value())) +
         line("", num_unproven == 0
                      ? "the Jacobian is proven positive in every hex of second order"
                      : fmt::format("{} proven not positive, {} undecided",
                                    grouped(q.num_not_positive), grouped(q.num_undecided)));
}

std::string volume_line(const Verdict& v) {
  std::string text =
      fmt::format("{:.6g}", v.second_order ? v.second_order->total_volume : v.quality.total_volume);
  if (v.volume_error)
    text += fmt::format(", {:.3f} % {} than the surface's", 100 * std::abs(*v.volume_error),
                        *v.volume_error > 0 ? "more" : "less");
  return line("volume", text);
}

std::string bound_of(const DistanceUpperBound& upper) {
  const double percent = 100 * upper.two_way();
  return upper.has_excuses ? fmt::format(" (at most {:.4f} %, as far as samples tell)", percent)
                           : fmt::format(" (proven: at most {:.4f} %)", percent);
}

std::string distance_lines(const SurfaceDistance& d) {
  const std::string bound = d.upper ? bound_of(*d.upper) : "";
  return line("distance", fmt::format("largest {:.4f} %{}, mean {:.4f} % of the diagonal",
                                      100 * d.max_two_way(), bound, 100 * d.mean_two_way())) +
         line("", fmt::format("surface to mesh {:.4f} % ({:.4f} %), mesh to surface {:.4f} % "
                              "({:.4f} %)",
                              100 * d.max_to_mesh, 100 * d.mean_to_mesh, 100 * d.max_to_surface,
                              100 * d.mean_to_surface));
}

std::string feature_lines(const FeatureRecovery& f) {
  if (!(f.total_length > 0) && f.num_corners == 0)
    return line("features", "none on the surface long enough to count");
  return line("features",
              fmt::format("{:.2f} % of their length, {} of {} corners", 100 * f.length_share,
                          grouped(f.num_corners_recovered), grouped(f.num_corners)));
}

// One bar per bin, from the best down to the worst that is not empty.
std::string histogram_lines(const QualitySummary& q) {
  if (q.num_hexes == 0) return {};
  const auto& counts = q.histogram;
  const std::size_t longest = *std::max_element(counts.begin(), counts.end());
  std::size_t lowest = 0;
  while (counts[lowest] == 0) ++lowest;
  std::string text = "\n  scaled Jacobian\n";
  for (std::size_t i = counts.size(); i-- > lowest;) {
    const double from = (static_cast<double>(i) - 10) / 10;
    const double share = static_cast<double>(counts[i]) / static_cast<double>(longest);
    const auto filled = static_cast<std::size_t>(std::ceil(share * kBarWidth));
    text += fmt::format("  {:>4.1f} ..{:>4.1f} |{:<{}}| {:>9}  {:5.1f} %\n", from, from + 0.1,
                        std::string(filled, '#'), kBarWidth, grouped(counts[i]),
                        100 * static_cast<double>(counts[i]) / static_cast<double>(q.num_hexes));
  }
  return text;
}

std::string sentences(const char* label, const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& sentence : list) text += fmt::format("  {}: {}\n", label, sentence);
  return text;
}

}  // namespace

/// The judgement first, then its reasons, then the figures; the histogram last, because it is long.
std::string verdict_to_text(const Verdict& verdict) {
  std::string text = verdict.is_valid() ? "VALID hex mesh\n" : "NOT A VALID hex mesh\n";
  text += sentences("failure", verdict.failures);
  text += sentences("warning", verdict.warnings);
  return text + figures_to_text(verdict) + histogram_lines(verdict.quality);
}

std::string figures_to_text(const Verdict& verdict) {
  std::string text = topology_lines(verdict) + quality_lines(verdict.quality);
  if (verdict.quality.num_hexes > 0 && verdict.second_order)
    text += second_order_lines(*verdict.second_order);
  if (verdict.quality.num_hexes > 0) text += volume_line(verdict);
  if (verdict.distance) text += distance_lines(*verdict.distance);
  if (verdict.features) text += feature_lines(*verdict.features);
  return text;
}

}  // namespace hexwright
