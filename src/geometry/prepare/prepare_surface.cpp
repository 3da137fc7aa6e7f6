// Check, weld, clean, orient, close, judge: the passes in order, with a sentence for what each
// found.
#include "hexwright/geometry/prepare_surface.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "hexwright/geometry/similarity.h"
#include "hexwright/geometry/surface_tree.h"

#include "base/words.h"
#include "geometry/prepare/canonical_order.h"
#include "geometry/prepare/surface_clean.h"
#include "geometry/prepare/surface_groups.h"
#include "geometry/prepare/surface_orient.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// Volume below this share of area x diagonal is rounding, not a solid.
constexpr double kLeastVolume = 1e-12;
/// A point counts as inside an open surface above this winding number; beside a lone sheet it comes
/// close to one half.
constexpr double kClearlyInside = 0.55;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadGeometry, message);
}

void check_input(const TriMesh& input) {
  if (input.num_tris() == 0)
    refuse("the surface has no triangles; check that the file holds faces and was exported whole");
  for (TriId t : input.tris.ids())
    for (VertId v : input.tris[t]) {
      if (!v.is_valid() || v.index() >= input.num_verts())
        refuse("triangle " + std::to_string(t.value()) + " uses vertex " +
               std::to_string(v.value()) + " of " + std::to_string(input.num_verts()) +
               "; repair the file's indices");
      if (!is_finite(input.positions[v]))
        refuse("vertex " + std::to_string(v.value()) + " (used by triangle " +
               std::to_string(t.value()) +
               ") has a coordinate that is not a finite number; repair or remove it");
    }
  const Box3 box = bounding_box(input);
  if (box.lo == box.hi)
    refuse("all vertices lie at one point; check the file's coordinates and units");
}

/// Vertices no triangle uses may lie anywhere, also at infinity: they must not reach arithmetic.
TriMesh used_only(const TriMesh& input) {
  IdVector<VertId, char> is_used(input.num_verts(), 0);
  for (const auto& tri : input.tris)
    for (VertId v : tri) is_used[v] = 1;
  TriMesh mesh = input;
  mesh.group.clear();  // follows at the end, by the source of each triangle
  mesh.group_names.clear();
  for (VertId v : mesh.positions.ids())
    if (!is_used[v]) mesh.positions[v] = input.positions[input.tris[TriId(0)][0]];
  return mesh;
}

/// Refuses what lies in one plane, within the rounding of positions in the unit frame.
void check_not_flat(const TriMesh& mesh) {
  Vec3 normal, origin;
  double largest = -1;
  for (TriId t : mesh.tris.ids()) {
    const auto c = mesh.corners(t);
    const Vec3 n = cross(c[1] - c[0], c[2] - c[0]);
    if (norm_sq(n) <= largest) continue;
    largest = norm_sq(n);
    normal = normalized(n);
    origin = c[0];
  }
  constexpr double kRounding = 1e-14;
  for (TriId t : mesh.tris.ids())
    for (const Vec3& p : mesh.corners(t))
      if (std::abs(dot(normal, p - origin)) > kRounding) return;
  refuse("the surface is flat and encloses no volume; give it thickness");
}

/// Counts the open edges and refuses triangles that are no surface at all.
void judge_openness(const TriMesh& mesh, SurfaceDiagnosis& diagnosis) {
  const SurfaceEdges edges = compute_surface_edges(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e)
    diagnosis.num_boundary_edges += edges.sides_of(e).size() == 1;
  if (2 * diagnosis.num_boundary_edges > edges.size())
    refuse("the triangles do not join to a surface: " +
           std::to_string(diagnosis.num_boundary_edges) + " of " + std::to_string(edges.size()) +
           " edges belong to one triangle only; export the model as a connected (watertight) mesh");
}

void judge_edges(const TriMesh& mesh, SurfaceDiagnosis& diagnosis) {
  const SurfaceEdges edges = compute_surface_edges(mesh);
  diagnosis.is_closed = true;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    diagnosis.num_nonmanifold_edges += sides.size() > 2;
    diagnosis.is_closed =
        diagnosis.is_closed && sides.size() == 2 && sides[0].is_forward != sides[1].is_forward;
  }
}

/// Looks for points well inside: along the inward normals and on a lattice over the box.
bool encloses_something(const TriMesh& mesh) {
  const SurfaceTree tree(mesh);
  const double diagonal = tree.box().diagonal();
  const std::size_t count = std::min<std::size_t>(mesh.num_tris(), 500);
  for (std::size_t i = 0; i < count; ++i) {
    const TriId t(i * mesh.num_tris() / count);
    const auto c = mesh.corners(t);
    for (double depth : {1e-3, 1e-2, 5e-2})
      if (tree.winding_number((c[0] + c[1] + c[2]) / 3 - tree.normal(t) * (depth * diagonal)) >
          kClearlyInside)
        return true;
  }
  constexpr int kLattice = 12;
  const Vec3 step = tree.box().extent() / kLattice;
  for (int x = 0; x < kLattice; ++x)
    for (int y = 0; y < kLattice; ++y)
      for (int z = 0; z < kLattice; ++z) {
        const Vec3 offset{(x + 0.5) * step.x, (y + 0.5) * step.y, (z + 0.5) * step.z};
        if (tree.winding_number(tree.box().lo + offset) > kClearlyInside) return true;
      }
  return false;
}

[[noreturn]] void refuse_no_volume(const std::string& why) {
  refuse("the surface encloses no volume (" + why + "); give it thickness or close it");
}

void check_volume(const TriMesh& mesh) {
  if (enclosed_volume(mesh) <= kLeastVolume * total_area(mesh) * bounding_box(mesh).diagonal())
    refuse_no_volume("its two sides coincide");
}

/// Closes the holes of a surface that is nearly closed. What is far from closed has no inside that
/// patches could complete: two triangles would become a solid.
void close_holes(WorkingSurface& work, SurfaceDiagnosis& diagnosis) {
  judge_openness(work.mesh, diagnosis);
  if (diagnosis.num_boundary_edges == 0) return;
  if (!encloses_something(work.mesh)) refuse_no_volume("it is too open to have an inside");
  const double given = total_area(work.mesh);
  diagnosis.num_filled_holes = fill_holes(work);
  // A sheet's hull is its patch over again: what that encloses is not meant as a solid. A half
  // sphere has a patch of half its area.
  constexpr double kPatchOfSheet = 0.7;
  if (total_area(work.mesh) - given > kPatchOfSheet * given)
    refuse_no_volume(
        "it is an open sheet: to close it would take a patch nearly as large as itself");
}

/// The result in the input's coordinates, without the vertices that nothing uses.
TriMesh compact(const WorkingSurface& work, const Similarity& frame,
                const IdVector<VertId, Vec3>& given) {
  TriMesh out;
  IdVector<VertId, char> is_used(work.mesh.num_verts(), 0);
  for (const auto& tri : work.mesh.tris)
    for (VertId v : tri) is_used[v] = 1;
  const auto position = [&](VertId v) {
    if (v.index() < given.size()) return given[v];
    const VertId from = work.added_from[v.index() - given.size()];
    return from.is_valid() ? given[from] : frame.to_world(work.mesh.positions[v]);
  };
  IdVector<VertId, VertId> old_to_new(work.mesh.num_verts());
  for (VertId v : work.mesh.positions.ids())
    if (is_used[v]) old_to_new[v] = out.positions.push_back(position(v));
  for (const auto& tri : work.mesh.tris)
    out.tris.push_back({old_to_new[tri[0]], old_to_new[tri[1]], old_to_new[tri[2]]});
  return out;
}

std::vector<std::string> describe(const SurfaceDiagnosis& d, const Orientation& o,
                                  std::size_t num_flat_kept) {
  std::vector<std::string> said;
  if (d.num_degenerate_tris > 0)
    said.push_back(counted(d.num_degenerate_tris, "triangle", "triangles") +
                   " without area removed");
  if (num_flat_kept > 0)
    said.push_back(counted(num_flat_kept, "triangle", "triangles") +
                   " without area kept, because the surface would open without");
  if (d.num_duplicate_tris > 0)
    said.push_back(counted(d.num_duplicate_tris, "duplicate triangle", "duplicate triangles") +
                   " removed");
  if (d.num_flipped_tris > 0)
    said.push_back(counted(d.num_flipped_tris, "triangle", "triangles") +
                   " turned to agree with the surface around");
  if (d.is_flipped_whole)
    said.push_back("the surface was inside out and has been turned");
  else if (o.num_turned_parts > 0)
    said.push_back(counted(o.num_turned_parts, "part was", "parts were") +
                   " inside out and turned");
  if (o.num_twisted_edges > 0)
    said.push_back("the surface cannot be oriented consistently at " +
                   counted(o.num_twisted_edges, "edge", "edges") +
                   "; the result may be wrong there");
  if (d.num_hidden_parts > 0)
    said.push_back(counted(d.num_hidden_parts, "part", "parts") +
                   " with the solid on both sides ignored; turn a closed one inside out if it is "
                   "a cavity");
  if (d.num_boundary_edges > 0) {
    const std::string open =
        "the surface is open along " + counted(d.num_boundary_edges, "edge", "edges");
    said.push_back(d.num_filled_holes > 0
                       ? open + "; " + counted(d.num_filled_holes, "hole was", "holes were") +
                             " closed with patches over their borders; check that they are meant"
                       : open + "; inside is decided by the winding number");
  }
  if (d.num_nonmanifold_edges > 0)
    said.push_back(counted(d.num_nonmanifold_edges, "edge has", "edges have") +
                   " more than two triangles; inside is decided by the winding number");
  return said;
}

std::string in_words(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void describe_union(const UniteReport& united, double min_gap, SurfaceDiagnosis& diagnosis) {
  if (united.num_parts > 0)
    diagnosis.notes.push_back(std::to_string(united.num_parts) +
                              " parts that overlap or touch united into " +
                              std::to_string(united.num_results));
  if (united.num_closed > 0)
    diagnosis.warnings.push_back(
        fmt::format("gaps between parts that nearly coincide are closed, as far as they are "
                    "narrower than {:.3g}% of the diagonal; --parts as-is keeps all walls",
                    100 * min_gap));
  if (united.num_apart > 0)
    diagnosis.notes.push_back(std::to_string(united.num_apart) +
                              " parts that touch along edges or in points kept apart there");
  if (united.num_failed > 0)
    diagnosis.warnings.push_back(
        std::to_string(united.num_failed) +
        " parts that overlap or touch could not be united; inside is decided by the winding "
        "number: unite them in the program that made them if the mesh is wrong there");
}

/// Solids that are left out one by one, the first few with their places; voids by number.
void describe_small(const std::vector<SmallPart>& small, const Similarity& frame,
                    SurfaceDiagnosis& diagnosis) {
  constexpr std::size_t kMaxNamed = 5;
  for (const SmallPart& part : small) {
    ++(part.is_void ? diagnosis.num_small_voids : diagnosis.num_small_parts);
    if (part.is_void || diagnosis.num_small_parts > kMaxNamed) continue;
    const Vec3 at = frame.to_world(part.box.center()), size = part.box.extent();
    diagnosis.warnings.push_back(
        "the part at (" + in_words(at.x) + ", " + in_words(at.y) + ", " + in_words(at.z) + "), " +
        in_words(frame.length_to_world(std::max({size.x, size.y, size.z}))) +
        " long, is left out: it is smaller than the least part (--min-part)");
  }
  if (diagnosis.num_small_parts > kMaxNamed)
    diagnosis.warnings.push_back(
        counted(diagnosis.num_small_parts - kMaxNamed, "further part", "further parts") +
        " of such size left out");
  if (diagnosis.num_small_voids > 0)
    diagnosis.notes.push_back(
        counted(diagnosis.num_small_voids, "void inside the solid", "voids inside the solid") +
        " smaller than the least part filled");
}

}  // namespace

PreparedSurface prepare_surface(const TriMesh& input, const PrepareOptions& options,
                                const Context& context) {
  const auto watch = context.watch();
  check_input(input);
  const TriMesh used = used_only(input);
  const Similarity frame = compute_unit_frame(used);
  WorkingSurface work{to_unit(used, frame), {}, {}};
  for (TriId t : input.tris.ids()) work.source.push_back(t);

  PreparedSurface result;
  SurfaceDiagnosis& diagnosis = result.diagnosis;
  std::size_t num_flat_kept = 0;
  diagnosis.num_welded_verts = weld_open_edges(work.mesh);
  diagnosis.num_degenerate_tris = remove_degenerate_tris(work, num_flat_kept);
  diagnosis.num_duplicate_tris = remove_duplicate_tris(work, true);
  if (work.mesh.num_tris() == num_flat_kept)
    refuse("all triangles are without area; check the file's coordinates");
  check_not_flat(work.mesh);
  context.check_cancelled();
  // Before anything breaks a tie by it, and again for what was turned and added since.
  const auto old_to_new = put_in_canonical_order(work.mesh, work.source);

  const Orientation orientation = orient_surface(work.mesh, context);
  diagnosis.num_flipped_tris = orientation.num_repaired;
  diagnosis.is_flipped_whole = orientation.num_turned_parts == orientation.num_parts;
  close_holes(work, diagnosis);
  context.check_cancelled();
  const double unit_diagonal = bounding_box(work.mesh).diagonal();
  const UniteReport united =
      unite_parts(work, options.parts, options.min_gap * unit_diagonal, input.group);
  diagnosis.num_united_parts = united.num_parts;
  diagnosis.num_unions = united.num_results;
  diagnosis.num_gaps_closed = united.num_closed;
  diagnosis.num_duplicate_tris += remove_duplicate_tris(work);
  const bool had_slits = close_slits(work, options.parts);
  const std::vector<SmallPart> small =
      drop_small_parts(work, options.min_part * bounding_box(work.mesh).diagonal());
  diagnosis.num_hidden_parts = drop_hidden_parts(work);
  judge_edges(work.mesh, diagnosis);
  if (diagnosis.is_closed) check_volume(work.mesh);

  diagnosis.warnings = describe(diagnosis, orientation, num_flat_kept);
  describe_small(small, frame, diagnosis);
  describe_union(united, options.min_gap, diagnosis);
  if (had_slits)
    diagnosis.notes.push_back(
        "slits without width closed: walls that lie on each other are none (--parts separate keeps "
        "them)");
  for (const std::string& warning : diagnosis.warnings) context.warn(warning);
  result.mesh = compact(work, frame, renumber(input.positions, old_to_new));
  result.source_tri = std::move(work.source);
  put_in_canonical_order(result.mesh, result.source_tri);
  carry_groups(input, result);
  return result;
}

}  // namespace hexwright
