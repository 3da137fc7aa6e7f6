#include "pipeline/bodies_apart.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "hexwright/geometry/surface_names.h"

#include "geometry/topology/bodies.h"
#include "geometry/tree/point_tree.h"
#include "geometry/tree/triangle_contacts.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// A part is meshed no coarser than this share of its own diagonal, however large the whole is.
constexpr double kCoarsest = 0.02;

/// Bodies nearer than so many tolerances are meshed apart: one grid would need cells of half the
/// gap to tell them apart, finer than the tolerance asks for.
constexpr double kGapOfTolerance = 2;

/// Ends of feature edges and vertices this near to each other, a share of the diagonal, are one.
constexpr double kSamePoint = 1e-5;

/// For each body the bodies before it that come within the gap.
std::vector<std::vector<std::size_t>> find_neighbours(const std::vector<ClosedPiece>& bodies,
                                                      double gap) {
  std::vector<std::vector<std::size_t>> neighbours(bodies.size());
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const NearSurface body(bodies[i].mesh);
    for (std::size_t j = 0; j < i; ++j)
      if (body.is_within(bodies[j].mesh, gap)) neighbours[i].push_back(j);
  }
  return neighbours;
}

/// The first part that holds no neighbour, body by body: two parts for a row of touching balls.
std::vector<std::size_t> choose_parts(const std::vector<std::vector<std::size_t>>& neighbours) {
  std::vector<std::size_t> parts;
  for (const auto& before : neighbours) {
    std::set<std::size_t> taken;
    for (std::size_t j : before) taken.insert(parts[j]);
    std::size_t part = 0;
    while (taken.contains(part)) ++part;
    parts.push_back(part);
  }
  return parts;
}

void append(TriMesh& part, const ClosedPiece& body, const TriMesh& surface) {
  append(part, body.mesh);
  for (TriId t : body.tri_to_surface)
    if (!surface.group.empty()) part.group.push_back(surface.group[t]);
  part.group_names = surface.group_names;
}

/// One more than the largest number in use.
template <class Element, class IdType>
std::size_t count_ids(const std::vector<Element>& elements, IdType Element::*id,
                      std::size_t num_names) {
  std::size_t count = num_names;
  for (const Element& element : elements)
    if ((element.*id).is_valid()) count = std::max(count, (element.*id).index() + 1);
  return count;
}

template <class Element, class IdType, std::size_t N>
void append_labels(std::vector<Element>& to, const std::vector<Element>& from, std::size_t verts,
                   IdType Element::*id, std::size_t ids, std::array<VertId, N> Element::*corners) {
  for (Element element : from) {
    for (VertId& v : element.*corners) v = VertId(v.index() + verts);
    if ((element.*id).is_valid()) element.*id = IdType((element.*id).index() + ids);
    to.push_back(element);
  }
}

template <class Names>
void append_names(Names& to, const Names& from, std::size_t ids) {
  if (to.empty() && from.empty()) return;
  to.resize(ids);
  for (const std::string& name : from.raw()) to.push_back(name);
}

void append(BoundaryLabels& to, const BoundaryLabels& from, std::size_t verts) {
  const std::size_t patches = count_ids(to.quads, &LabeledQuad::patch, to.patch_names.size());
  const std::size_t curves = count_ids(to.edges, &LabeledEdge::curve, to.curve_names.size());
  append_labels(to.quads, from.quads, verts, &LabeledQuad::patch, patches, &LabeledQuad::verts);
  append_labels(to.edges, from.edges, verts, &LabeledEdge::curve, curves, &LabeledEdge::verts);
  for (VertId v : from.corners) to.corners.push_back(VertId(v.index() + verts));
  append_names(to.patch_names, from.patch_names, patches);
  append_names(to.curve_names, from.curve_names, curves);
}

void append(MidNodes& to, const MidNodes& from) {
  const std::size_t edges = to.edges.size();
  for (auto hex_edges : from.hex_to_edge) {
    for (EdgeId& e : hex_edges) e = EdgeId(e.index() + edges);
    to.hex_to_edge.push_back(hex_edges);
  }
  for (const Vec3& p : from.edges) to.edges.push_back(p);
  for (const auto& inner : from.inner) to.inner.push_back(inner);
}

/// A region per part.
void append(HexMesh& to, const HexMesh& from, std::int32_t region, const std::string& name) {
  const std::size_t verts = to.num_verts();
  for (const Vec3& p : from.positions) to.positions.push_back(p);
  for (std::array<VertId, 8> hex : from.hexes) {
    for (VertId& v : hex) v = VertId(v.index() + verts);
    to.hexes.push_back(hex);
    to.region.push_back(region);
  }
  append(to.labels, from.labels, verts);
  if (verts == 0)
    to.mid_nodes = from.mid_nodes;
  else if (to.mid_nodes && from.mid_nodes)
    append(*to.mid_nodes, *from.mid_nodes);
  else
    to.mid_nodes.reset();
  to.region_names.resize(static_cast<std::size_t>(region) + 1);
  to.region_names.back() = name;
}

using Seconds = std::vector<std::pair<std::string, double>>;

void add(Seconds& to, const Seconds& from) {
  for (const auto& [name, seconds] : from) {
    const auto same = std::ranges::find(to, name, &Seconds::value_type::first);
    if (same == to.end())
      to.emplace_back(name, seconds);
    else
      same->second += seconds;
  }
}

void add(std::vector<StageRecord>& to, const std::vector<StageRecord>& from) {
  for (const StageRecord& stage : from) {
    const auto same = std::ranges::find(to, stage.name, &StageRecord::name);
    if (same == to.end()) {
      to.push_back(stage);
      continue;
    }
    same->seconds += stage.seconds;
    for (const auto& [name, count] : stage.counts) same->counts[name] += count;
  }
}

void append(FitReport& to, FitReport&& from, std::size_t hexes, std::size_t curves) {
  to.num_hexes_carved += from.num_hexes_carved;
  to.num_hexes_padded += from.num_hexes_padded;
  to.num_curves += from.num_curves;
  to.num_curves_mapped += from.num_curves_mapped;
  to.curve_length += from.curve_length;
  to.curve_length_mapped += from.curve_length_mapped;
  to.num_corners += from.num_corners;
  to.num_corners_mapped += from.num_corners_mapped;
  for (CurveOutcome& curve : from.curves) {
    if (curve.curve.is_valid()) curve.curve = CurveId(curve.curve.index() + curves);
    to.curves.push_back(std::move(curve));
  }
  to.misses.insert(to.misses.end(), from.misses.begin(), from.misses.end());
  for (HexId h : from.unproven) to.unproven.push_back(HexId(h.index() + hexes));
  add(to.seconds, from.seconds);
  add(to.processor_seconds, from.processor_seconds);
}

void append(CurvingReport& to, const CurvingReport& from) {
  to.num_edges += from.num_edges;
  to.num_surface_edges += from.num_surface_edges;
  to.num_curved += from.num_curved;
  to.num_unmatched += from.num_unmatched;
  to.max_offset = std::max(to.max_offset, from.max_offset);
  to.held_back.insert(to.held_back.end(), from.held_back.begin(), from.held_back.end());
}

void append(ExactReport& to, const ExactReport& from) {
  to.num_verts += from.num_verts;
  to.num_exact += from.num_exact;
  to.num_short += from.num_short;
  to.max_before = std::max(to.max_before, from.max_before);
  to.max_after = std::max(to.max_after, from.max_after);
}

/// Records of a part as shares of the whole's diagonal, which is `ratio` parts long.
void scale_shares(MeshResult& part, double ratio) {
  for (RoundRecord& round : part.rounds) {
    round.max_distance /= ratio;
    round.mean_distance /= ratio;
  }
  if (!part.exact) return;
  part.exact->max_before /= ratio;
  part.exact->max_after /= ratio;
}

void append_records(MeshResult& all, MeshResult&& part) {
  const BoundaryLabels& labels = all.mesh.labels;
  append(all.fit, std::move(part.fit), all.mesh.num_hexes(),
         count_ids(labels.edges, &LabeledEdge::curve, labels.curve_names.size()));
  for (const std::int8_t level : part.levels) all.levels.push_back(level);
  if (all.exact && part.exact) append(*all.exact, *part.exact);
  if (all.curving && part.curving) append(*all.curving, *part.curving);
  add(all.stages, part.stages);
  all.rounds.insert(all.rounds.end(), part.rounds.begin(), part.rounds.end());
  all.num_rounds += part.num_rounds;
  all.is_limited = all.is_limited || part.is_limited;
  all.failures.insert(all.failures.end(), part.failures.begin(), part.failures.end());
}

/// The group that a patch was named for: "wall" of "wall.2".
std::string group_of(const std::string& name, const std::set<std::string>& groups) {
  if (groups.contains(name)) return name;
  const std::string base = name.substr(0, name.rfind('.'));
  return groups.contains(base) ? base : name;
}

/// "inlet-wall" of "inlet-wall.2".
std::string unnumbered_curve(const std::string& name, const std::set<std::string>& groups) {
  const auto ends_with_group = [&](const std::string& text) {
    return std::ranges::any_of(
        groups, [&](const std::string& group) { return text.ends_with("-" + group); });
  };
  const std::string base = name.substr(0, name.rfind('.'));
  return !ends_with_group(name) && ends_with_group(base) ? base : name;
}

template <class Names>
void number_again(Names& names) {
  std::vector<std::string> texts = names.raw();
  number_repeated(texts);
  names = Names(std::move(texts));
}

std::string name_of_part(const HexMesh& mesh) {
  return mesh.region_names.empty() ? "" : mesh.region_names.back();
}

/// The groups of the part's patches; the part's own for those of a part of one group.
void name_by_groups(const TriMesh& surface, HexMesh& mesh) {
  if (!has_named_patches(surface)) return;
  const std::set<std::string> groups(surface.group_names.begin(), surface.group_names.end());
  BoundaryLabels& labels = mesh.labels;
  for (std::string& name : labels.patch_names) name = group_of(name, groups);
  for (std::string& name : labels.curve_names) name = unnumbered_curve(name, groups);
  if (labels.patch_names.empty())
    labels.patch_names.resize(count_ids(labels.quads, &LabeledQuad::patch, 0), name_of_part(mesh));
}

/// Names of patches and curves are those of the whole surface.
bool asks_by_name(const SizeWishes& sizes) {
  return std::ranges::any_of(sizes.rules, [](const SizeRule& rule) {
    return rule.where == SizeRule::Where::Patch || rule.where == SizeRule::Where::Curve;
  });
}

/// Shares of the whole's diagonal as lengths.
void fix_lengths(SizeWishes& sizes, double diagonal) {
  const auto fix = [&](Length& length) { length = {length.in(diagonal), false}; };
  fix(sizes.size);
  fix(sizes.max_size);
  fix(sizes.min_size);
  for (SizeRule& rule : sizes.rules) {
    fix(rule.size);
    fix(rule.distance);
  }
}

/// Feature edges of other parts are none of this one's.
void keep_own_segments(const TriMesh& surface, std::vector<std::array<Vec3, 2>>& segments) {
  if (segments.empty()) return;
  const double reach = kSamePoint * bounding_box(surface).diagonal();
  const PointTree points(surface.positions.raw());
  const auto is_vert = [&](const Vec3& p) {
    bool any = false;
    const Vec3 around{reach, reach, reach};
    points.visit_box({p - around, p + around}, [&](std::size_t) { any = true; });
    return any;
  };
  std::erase_if(segments, [&](const auto& s) { return !is_vert(s[0]) || !is_vert(s[1]); });
}

}  // namespace

std::vector<TriMesh> split_near_bodies(const Target& target, double gap) {
  const TriMesh& surface = target.surface();
  if (gap < 0) return {};
  const std::vector<ClosedPiece> bodies = find_bodies(surface);
  std::size_t num_tris = 0;
  for (const ClosedPiece& body : bodies) num_tris += body.mesh.num_tris();
  if (bodies.empty() || num_tris != surface.num_tris()) return {};
  const std::vector<std::size_t> body_to_part = choose_parts(find_neighbours(bodies, gap));
  std::vector<TriMesh> parts(std::ranges::max(body_to_part) + 1);
  if (parts.size() < 2) return {};
  for (std::size_t b = 0; b < bodies.size(); ++b)
    append(parts[body_to_part[b]], bodies[b], surface);
  for (TriMesh& part : parts) part = to_world(std::move(part), target.frame);
  return parts;
}

std::string say_groups(std::size_t num_parts) {
  return fmt::format(
      "bodies that touch or nearly touch are meshed each by itself, in {} groups (--gap)",
      num_parts);
}

double plan_gap(const MeshOptions& options, const Target& target) {
  const bool is_alone = options.fit.carve.side == Side::Inside && options.gap != 0 &&
                        options.target.prepare.parts != Parts::AsIs && options.layers.empty() &&
                        !asks_by_name(options.sizes);
  if (!is_alone) return -1;
  return (options.gap > 0 ? options.gap : kGapOfTolerance * options.sizing.tolerance) *
         target.diagonal();
}

MeshOptions plan_part(const MeshOptions& options, const Target& whole, const TriMesh& surface) {
  MeshOptions part = options;
  const double diagonal = whole.frame.length_to_world(whole.diagonal());
  const double ratio = bounding_box(surface).diagonal() / diagonal;
  fix_lengths(part.sizes, diagonal);
  const double tolerance = options.sizing.tolerance / ratio;
  part.sizing.tolerance = std::max(options.sizing.tolerance, std::min(tolerance, kCoarsest));
  part.edge_tolerance /= ratio;
  part.corner_tolerance /= ratio;
  part.target.prepare.min_part = 0;  // what is left is meant to be there
  part.target.features.min_length = whole.frame.length_to_world(whole.feature_options.min_length);
  keep_own_segments(surface, part.target.features.extra_segments);
  return part;
}

MeshResult join_parts(std::vector<MeshResult>&& parts, const Target& whole) {
  for (MeshResult& part : parts)
    scale_shares(part, whole.frame.length_to_world(whole.diagonal()) / part.diagonal);
  MeshResult all = std::move(parts.front());
  HexMesh first = std::exchange(all.mesh, {});
  for (std::size_t k = 0; k < parts.size(); ++k) {
    HexMesh& mesh = k == 0 ? first : parts[k].mesh;
    name_by_groups(whole.surface(), mesh);
    if (k > 0) append_records(all, std::move(parts[k]));
    append(all.mesh, mesh, static_cast<std::int32_t>(k), name_of_part(mesh));
  }
  number_again(all.mesh.labels.patch_names);
  number_again(all.mesh.labels.curve_names);
  return all;
}

}  // namespace hexwright
