// Measures a surface as it is, then as preparation leaves it.
#include "hexwright/pipeline/inspect.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/shape_diameter.h"
#include "hexwright/geometry/similarity.h"
#include "hexwright/pipeline/plan.h"

#include "base/words.h"
#include "geometry/topology/closed_pieces.h"
#include "geometry/tree/triangle_contacts.h"
#include "mesh/tri_measures.h"
#include "pipeline/bodies_apart.h"

namespace hexwright {
namespace {

/// Crossings shallower than this, in the unit frame, are contacts or rounding.
constexpr double kCrossingDepth = 1e-6;
/// Between samples of the walls, share of the diagonal.
constexpr double kWallSpacing = 0.01;

/// Files have no units; most parts are drawn in millimetres and are centimetres to metres long.
std::string guess_units(double diagonal) {
  if (diagonal < 1e-3 || diagonal > 1e5) return "of unusual size: check the units";
  if (diagonal < 5) return "if this is a part of a machine, its units may be metres";
  if (diagonal > 2e4) return "if this is a part of a machine, its units may be micrometres";
  return {};
}

void count_names(const TriMesh& surface, SurfaceInspection& result) {
  for (const std::string& name : surface.group_names) result.names.push_back({name, 0});
  for (std::int32_t g : surface.group)
    if (g >= 0) ++result.names[static_cast<std::size_t>(g)].num_tris;
}

/// Pieces of the surface as it is, welded and oriented.
void count_pieces(const TriMesh& mesh, SurfaceInspection& result) {
  result.num_open_tris = mesh.num_tris();
  for (const ClosedPiece& piece : split_closed_pieces(mesh)) {
    ++(piece.volume > 0 ? result.num_solids : result.num_cavities);
    result.num_open_tris -= piece.mesh.num_tris();
  }
}

std::vector<TriPair> find_crossing_pairs(const TriMesh& unit) {
  return find_near_pairs(unit, 0, [&](TriId a, TriId b) {
    return find_crossing(unit.corners(a), unit.corners(b), kCrossingDepth).has_value();
  });
}

void find_crossings(const TriMesh& mesh, SurfaceInspection& result) {
  const Similarity frame = compute_unit_frame(mesh);
  const TriMesh unit = to_unit(mesh, frame);
  const std::vector<TriPair> pairs = find_crossing_pairs(unit);
  result.num_crossings = pairs.size();
  const std::size_t num_shown = std::min(pairs.size(), result.kMaxPlaces);
  for (std::size_t i = 0; i < num_shown; ++i) {
    const auto& [a, b] = pairs[i * pairs.size() / num_shown];
    const auto at = find_crossing(unit.corners(a), unit.corners(b), kCrossingDepth);
    result.crossings.push_back({frame.to_world(*at)});
  }
}

/// Walls thinner than a share of the diagonal.
void find_thin(const Target& target, double share, const Context& context,
               SurfaceInspection& result) {
  const double diagonal = target.frame.length_to_world(target.diagonal());
  const double spacing = kWallSpacing * diagonal, limit = share * diagonal;
  std::vector<WallSample> walls =
      sample_opposite_walls(target.tree, kWallSpacing * target.diagonal(), context);
  std::erase_if(walls, [](const WallSample& w) { return !std::isfinite(w.inner); });
  std::ranges::stable_sort(walls, {}, &WallSample::inner);
  for (WallSample& w : walls) w.to_world(target.frame);
  result.num_wall_samples = walls.size();
  if (!walls.empty()) result.least_thickness = walls.front().inner;
  for (const WallSample& w : walls) {
    if (w.inner >= limit) break;
    ++result.num_thin_samples;
    // One of a neighbourhood.
    const bool is_near = std::ranges::any_of(result.thin, [&](const InspectedPlace& p) {
      return distance(p.position, w.point) < 5 * spacing;
    });
    if (!is_near && result.thin.size() < result.kMaxPlaces)
      result.thin.push_back({w.point, w.inner});
  }
}

/// To two digits.
double round_down(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::floor(value / unit * (1 + 1e-12)) * unit;
}

/// What mesh would do about what preparation leaves.
void foretell(const Target& target, const MeshOptions& options, SurfaceInspection& result) {
  const std::size_t num_groups = split_near_bodies(target, plan_gap(options, target)).size();
  if (num_groups > 1) result.notes.push_back(say_groups(num_groups));
  const std::size_t num_crossings = find_crossing_pairs(target.surface()).size();
  if (num_crossings > 0)
    result.notes.push_back(fmt::format(
        "a surface that crosses itself, at {} of triangles: inside is where it winds around; walls "
        "inside are left out of sizes, features and distances; where it crosses, the mesh is "
        "rounded by about a cell",
        counted(num_crossings, "pair", "pairs")));
  if (result.num_thin_samples > 0)
    result.notes.push_back(fmt::format(
        "walls thinner than the tolerance are kept only where cells are as small: for all of them "
        "--tolerance {:.2g}%",
        round_down(100 * std::max(result.least_thickness / result.box.diagonal(), 1e-5))));
}

void measure_object(const TriMesh& surface, const MeshOptions& options, const Context& context,
                    SurfaceInspection& result) {
  const Target target = make_target(surface, plan_target(options), context);
  result.notes = target.diagnosis.notes;
  result.warnings = target.diagnosis.warnings;
  result.volume = target.frame.volume_to_world(enclosed_volume(target.surface()));
  find_thin(target, options.sizing.tolerance, context, result);
  result.sharp_length = target.frame.length_to_world(target.features.total_length());
  result.num_sharp_curves = target.features.curves.size();
  result.num_corners = target.features.corners.size();
  foretell(target, options, result);
}

}  // namespace

SurfaceInspection inspect_surface(const TriMesh& surface, const MeshOptions& options,
                                  const Context& context) {
  SurfaceInspection result;
  result.num_verts = surface.num_verts();
  result.num_tris = surface.num_tris();
  result.box = bounding_box(surface);
  result.units_guess = guess_units(result.box.diagonal());
  count_names(surface, result);
  Context quiet = context;  // what it says is in the result
  quiet.on_warning = nullptr;
  try {
    const PreparedSurface as_is = prepare_surface(surface, {.parts = Parts::AsIs}, quiet);
    result.area = total_area(as_is.mesh);
    count_pieces(as_is.mesh, result);
    result.num_open_edges = as_is.diagnosis.num_boundary_edges;
    result.num_nonmanifold_edges = as_is.diagnosis.num_nonmanifold_edges;
    find_crossings(as_is.mesh, result);
    measure_object(surface, options, quiet, result);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::BadGeometry) throw;
    result.refusal = e.what();
  }
  return result;
}

}  // namespace hexwright
