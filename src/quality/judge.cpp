// Runs every check on a hex mesh and says in sentences what is wrong with it.
#include "hexwright/quality/judge.h"

#include <fmt/format.h>

#include "hexwright/quality/judge_distance.h"

#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// All checks below index without looking.
void require_sound_arrays(const HexMesh& mesh) {
  if (const auto issue = mesh.find_problem())
    throw Error(ErrorCode::BadArgument, issue->message + "; repair the mesh's arrays first");
}

/// Inverted corners fail; the inside of elements only warns, because meshes of other programs are
/// judged as well, and most have no proof of it.
void add_quality_findings(Verdict& verdict) {
  const QualitySummary& q = verdict.quality;
  if (q.num_inverted > 0)
    verdict.failures.push_back(fmt::format(
        "{} hex(es) are inverted or flat; the worst is hex {} with a scaled Jacobian of "
        "{:.4g}",
        q.num_inverted, q.worst_hex.value(), q.min_scaled_jacobian));
  if (q.num_not_positive > q.num_inverted)
    verdict.warnings.push_back(
        fmt::format("{} hex(es) have positive corners but a Jacobian that is not positive inside",
                    q.num_not_positive - q.num_inverted));
  if (q.num_undecided > 0)
    verdict.warnings.push_back(fmt::format(
        "{} hex(es) could not be proven to have a positive Jacobian inside", q.num_undecided));
}

/// A curved element that is not positive fails wherever it comes from: solvers refuse it.
void add_second_order_findings(Verdict& verdict) {
  const SecondOrderQuality& q = *verdict.second_order;
  if (q.num_not_positive > 0) {
    std::string names;
    for (HexId h : q.broken) names += fmt::format("{}{}", names.empty() ? "" : ", ", h.value());
    verdict.failures.push_back(fmt::format(
        "{} hex(es) of second order have a Jacobian that is not positive everywhere: hex {}{}",
        q.num_not_positive, names, q.num_not_positive > q.broken.size() ? " ..." : ""));
  }
  if (q.num_undecided > 0)
    verdict.warnings.push_back(
        fmt::format("{} hex(es) of second order could not be proven to have a positive Jacobian",
                    q.num_undecided));
}

/// What needs no surface.
Verdict judge_mesh(const HexMesh& mesh, const Context& context) {
  require_sound_arrays(mesh);
  Verdict verdict;
  if (mesh.num_hexes() == 0) verdict.failures.push_back("the mesh has no hexes");
  context.progress("check", 0);
  verdict.topology = check_topology(mesh);
  verdict.failures.insert(verdict.failures.end(), verdict.topology.problems.begin(),
                          verdict.topology.problems.end());
  context.check_cancelled();
  context.progress("check", 0.3);
  verdict.quality = summarize_quality(mesh);
  add_quality_findings(verdict);
  if (mesh.mid_nodes) {
    verdict.second_order = summarize_second_order(mesh);
    add_second_order_findings(verdict);
  }
  return verdict;
}

// Components and genus of the boundary beside those of the surface, where both are defined.
void compare_topology(Verdict& verdict, const JudgeOptions& options) {
  if (options.quads != JudgedQuads::Boundary) return;
  if (!verdict.surface->is_closed_manifold()) {
    verdict.warnings.push_back(
        "the surface is not a closed manifold: its components and genus were not compared");
    return;
  }
  const std::size_t components = verdict.topology.num_boundary_components;
  const bool is_same_count = components == verdict.surface->num_components;
  const bool is_same_genus = verdict.topology.genus() == verdict.surface->genus();
  verdict.has_other_topology = !is_same_count || !is_same_genus;
  if (!is_same_count)
    verdict.warnings.push_back(
        fmt::format("the mesh's boundary has {} component(s), the surface {}", components,
                    verdict.surface->num_components));
  if (!is_same_genus)
    verdict.warnings.push_back(fmt::format("the mesh's boundary has genus {}, the surface {}",
                                           verdict.topology.genus(), verdict.surface->genus()));
}

/// All of a sound surface bounds the solid: no sample need be excused.
DistanceOptions distance_options(const Target& target, const JudgeOptions& options) {
  return {.quads = options.quads,
          .spacing = options.spacing,
          .hot_threshold = options.hot_threshold,
          .solid_only = !target.expected.is_known,
          .domain = options.domain,
          .bound_gap = options.bound_gap};
}

void compare_volume(Verdict& verdict, const Target& target, const JudgeOptions& options) {
  const TriMesh& surface = target.surface();
  if (options.quads != JudgedQuads::Boundary || !verdict.surface->is_closed_manifold() ||
      !is_oriented_cycle(surface))
    return;
  const double volume = enclosed_volume(surface);
  const double own =
      verdict.second_order ? verdict.second_order->total_volume : verdict.quality.total_volume;
  if (volume > 0) verdict.volume_error = own / volume - 1;
}

/// Other units or another origin are the likely cause.
void warn_of_other_place(Verdict& verdict) {
  constexpr double kFarOff = 0.5;
  const double apart = verdict.distance->max_two_way();
  if (apart > kFarOff)
    verdict.warnings.push_back(
        fmt::format("the mesh and the surface lie up to {:.3g} diagonals of the surface apart: do "
                    "they have the same units and origin?",
                    apart));
}

}  // namespace

Verdict judge(const HexMesh& mesh, const JudgeOptions&, const Context& context) {
  const auto watch = context.watch();
  Verdict verdict = judge_mesh(mesh, context);
  context.progress("check", 1);
  return verdict;
}

Verdict judge(const HexMesh& mesh, const Target& target, const JudgeOptions& options,
              const Context& context) {
  const auto watch = context.watch();
  Verdict verdict = judge_mesh(mesh, context);
  context.check_cancelled();
  context.progress("check", 0.5);
  verdict.surface = target.topology;
  compare_topology(verdict, options);
  compare_volume(verdict, target, options);
  verdict.distance = judge_distance(mesh, target, options);
  warn_of_other_place(verdict);
  context.check_cancelled();
  context.progress("check", 0.9);
  verdict.features = measure_features(mesh, target.tree, target.features, options);
  context.progress("check", 1);
  return verdict;
}

Verdict judge(const HexMesh& mesh, const TriMesh& surface, const TargetOptions& target_options,
              const JudgeOptions& options, const Context& context) {
  require_sound_arrays(mesh);
  const Target target = make_target(surface, target_options, context);
  Verdict verdict = judge(to_unit(mesh, target.frame), target, options, context);
  verdict.to_world(target.frame);
  return verdict;
}

SurfaceDistance judge_distance(const HexMesh& mesh, const Target& target,
                               const JudgeOptions& options) {
  return measure_distance(mesh, target.tree, distance_options(target, options));
}

void Verdict::to_world(const Similarity& frame) {
  quality.to_world(frame);
  if (second_order) second_order->to_world(frame);
  if (distance) distance->to_world(frame);
  if (features) features->to_world(frame);
}

}  // namespace hexwright
