// Measures, centroids and simple shapes of sets.
#include "hexwright/io/set_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/mesh/hex_shape.h"

namespace hexwright {
namespace {

/// A quad by its centre and its area vector: exact for the bilinear surface.
struct QuadPlace {
  Vec3 center, area;
};

QuadPlace place_of(const HexMesh& mesh, const std::array<VertId, 4>& verts) {
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[verts[k]];
  return {(p[0] + p[1] + p[2] + p[3]) * 0.25, cross(p[2] - p[0], p[3] - p[1]) * 0.5};
}

/// Adds an element of this measure at its centre.
void add_element(SetSummary& summary, double measure, const Vec3& center) {
  summary.measure += measure;
  summary.centroid += center * measure;
}

void measure_elements(const HexMesh& mesh, const NamedSet& set, SetSummary& summary) {
  for (std::size_t i : set.members) {
    if (set.kind == SetKind::Region) {
      const auto corners = mesh.corners(HexId(i));
      Vec3 center;
      for (const Vec3& p : corners) center += p * 0.125;
      add_element(summary, hex_volume(corners), center);
    } else if (set.kind == SetKind::Curve) {
      const auto& [a, b] = mesh.labels.edges[i].verts;
      const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
      add_element(summary, distance(p, q), (p + q) * 0.5);
    } else if (set.kind == SetKind::Corners) {
      summary.centroid += mesh.positions[mesh.labels.corners[i]];
    } else {
      const QuadPlace place = place_of(mesh, mesh.labels.quads[i].verts);
      add_element(summary, norm(place.area), place.center);
    }
  }
  const double weight = set.kind == SetKind::Corners ? double(set.members.size()) : summary.measure;
  if (weight != 0) summary.centroid = summary.centroid / weight;
}

/// Finds the plane or cylinder that a patch is, from the normals of its quads.
class ShapeFinder {
 public:
  ShapeFinder(const HexMesh& mesh, const NamedSet& set, double diagonal, SetSummary& summary)
      : mesh_(mesh), set_(set), diagonal_(diagonal), summary_(summary) {
    for (std::size_t q : set.members) places_.push_back(place_of(mesh, mesh.labels.quads[q].verts));
  }

  void run() {
    if (!find_plane()) find_cylinder();
  }

 private:
  static constexpr double kPlane = 0.02;      // largest distance of a unit normal from the mean
  static constexpr double kFlatness = 1e-3;   // of a plane's vertices, share of the mesh's diagonal
  static constexpr double kAcross = 0.05;     // largest cosine between a normal and the axis
  static constexpr double kRoundness = 0.01;  // largest relative deviation of a radius

  bool find_plane() {
    Vec3 sum;
    for (const QuadPlace& place : places_) sum += place.area;
    const Vec3 mean = normalized(sum);
    for (const QuadPlace& place : places_)
      if (distance(normalized(place.area), mean) > kPlane) return false;
    for (std::size_t q : set_.members)
      for (VertId v : mesh_.labels.quads[q].verts)
        if (std::abs(dot(mesh_.positions[v] - summary_.centroid, mean)) > kFlatness * diagonal_)
          return false;
    summary_.shape = SetShape::Plane;
    summary_.direction = mean;
    return true;
  }

  /// Across the two normals that differ most from the first: where the iteration starts.
  Vec3 guess_axis() const {
    const Vec3 first = normalized(places_[0].area);
    Vec3 axis;
    for (const QuadPlace& place : places_) {
      const Vec3 candidate = cross(first, normalized(place.area));
      if (norm_sq(candidate) > norm_sq(axis)) axis = candidate;
    }
    return normalized(axis);
  }

  /// The direction that all normals lie across best: the least eigenvector of sum n n^T, as the
  /// greatest one of what it lacks to its trace, by power iteration. The first of its coordinates
  /// that is not small is positive.
  Vec3 find_axis() const {
    constexpr int kSteps = 100;
    std::array<Vec3, 3> rows;  // of the sum of (1 - n n^T), by area
    for (const QuadPlace& place : places_) {
      const Vec3 n = normalized(place.area);
      for (int k = 0; k < 3; ++k) {
        Vec3 row = n * -n[k];
        row[k] += 1;
        rows[static_cast<std::size_t>(k)] += row * norm(place.area);
      }
    }
    Vec3 axis = guess_axis();
    for (int k = 0; k < kSteps; ++k)
      axis = normalized({dot(rows[0], axis), dot(rows[1], axis), dot(rows[2], axis)});
    for (int k = 0; k < 3; ++k)
      if (std::abs(axis[k]) > 0.57) return axis[k] < 0 ? axis * -1 : axis;
    return axis;
  }

  void find_cylinder() {
    const Vec3 axis = find_axis();
    if (axis == Vec3{}) return;
    for (const QuadPlace& place : places_)
      if (std::abs(dot(normalized(place.area), axis)) > kAcross) return;
    const Vec3 u =
        normalized(std::abs(axis.x) < 0.9 ? cross(axis, {1, 0, 0}) : cross(axis, {0, 1, 0}));
    const Vec3 v = cross(axis, u);
    const auto center = find_center(u, v);
    double lo = INFINITY, hi = 0;
    for (std::size_t q : set_.members)
      for (VertId vert : mesh_.labels.quads[q].verts) {
        const Vec3 p = mesh_.positions[vert] - summary_.centroid;
        const double r = norm(Vec3{dot(p, u) - center[0], dot(p, v) - center[1], 0});
        lo = std::min(lo, r);
        hi = std::max(hi, r);
      }
    if (!(hi - lo <= kRoundness * hi) || hi > diagonal_) return;
    summary_.shape = SetShape::Cylinder;
    summary_.direction = axis;
    summary_.radius = (lo + hi) / 2;
  }

  /// The point of the plane (u, v) nearest to all lines along the normals, from the centroid: least
  /// squares, two unknowns.
  std::array<double, 2> find_center(const Vec3& u, const Vec3& v) const {
    double uu = 0, uv = 0, vv = 0, bu = 0, bv = 0;
    for (const QuadPlace& place : places_) {
      const double nx = dot(place.area, u), ny = dot(place.area, v);
      const double px = dot(place.center - summary_.centroid, u);
      const double py = dot(place.center - summary_.centroid, v);
      const double offset = ny * px - nx * py;  // ny * x - nx * y is the same along the line
      uu += ny * ny;
      uv -= nx * ny;
      vv += nx * nx;
      bu += ny * offset;
      bv -= nx * offset;
    }
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) return {0, 0};
    return {(vv * bu - uv * bv) / determinant, (uu * bv - uv * bu) / determinant};
  }

  const HexMesh& mesh_;
  const NamedSet& set_;
  double diagonal_;
  SetSummary& summary_;
  std::vector<QuadPlace> places_;
};

/// What is zero but for rounding is zero.
Vec3 without_dust(Vec3 v, double scale) {
  constexpr double kDust = 1e-12;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(v[axis]) <= kDust * scale) v[axis] = 0;
  return v;
}

SetSummary summarize(const HexMesh& mesh, const NamedSet& set, double diagonal) {
  SetSummary summary;
  summary.kind = set.kind;
  summary.name = set.name;
  summary.num_elements = set.members.size();
  measure_elements(mesh, set, summary);
  if (set.kind == SetKind::Patch || set.kind == SetKind::PatchGroup)
    ShapeFinder(mesh, set, diagonal, summary).run();
  summary.centroid = without_dust(summary.centroid, diagonal);
  summary.direction = without_dust(summary.direction, 1);
  return summary;
}

/// "patch_zmax", "patch_cyl_r5", or "" where the place is not plain.
std::string place_name(const SetSummary& patch, const Box3& box) {
  constexpr double kAlong = 1 - 1e-4, kNear = 1e-3;
  if (patch.shape == SetShape::Cylinder) {
    // Letters that every format takes; a point would make "patch_cyl_r2.5" a part of a group.
    std::string name = fmt::format("patch_cyl_r{:.3g}", patch.radius);
    for (char& c : name)
      if (!is_word_letter(c)) c = '_';
    return name;
  }
  if (patch.shape != SetShape::Plane) return "";
  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_max : {false, true}) {
      const double along = (is_max ? 1 : -1) * patch.direction[axis];
      const double gap = std::abs(patch.centroid[axis] - (is_max ? box.hi : box.lo)[axis]);
      if (along > kAlong && gap <= kNear * box.diagonal())
        return fmt::format("patch_{}{}", "xyz"[axis], is_max ? "max" : "min");
    }
  return "";
}

const char* kind_name(SetKind kind) {
  switch (kind) {
    case SetKind::Region:
      return "region";
    case SetKind::Patch:
      return "patch";
    case SetKind::PatchGroup:
      return "group";
    case SetKind::Curve:
      return "curve";
    default:
      return "corners";
  }
}

}  // namespace

std::vector<SetSummary> summarize_sets(const HexMesh& mesh, const SetTable& table) {
  const double diagonal = bounding_box(mesh).diagonal();
  std::vector<SetSummary> summaries;
  for (const auto* sets :
       {&table.regions, &table.patches, &table.patch_groups, &table.curves, &table.corners})
    for (const NamedSet& set : *sets) summaries.push_back(summarize(mesh, set, diagonal));
  return summaries;
}

void name_by_place(const HexMesh& mesh, SetTable& table) {
  const Box3 box = bounding_box(mesh);
  std::map<std::string, std::vector<NamedSet*>> name_to_sets;
  for (NamedSet& set : table.patches)
    if (!set.is_given && set.number >= 0)
      name_to_sets[place_name(summarize(mesh, set, box.diagonal()), box)].push_back(&set);
  for (const NamedSet& set : table.patches) name_to_sets.erase(set.name);  // a user's name
  for (const auto& [name, sets] : name_to_sets)
    if (!name.empty() && sets.size() == 1) sets[0]->name = name;
}

std::string sets_to_json(const std::vector<SetSummary>& sets) {
  const auto vector = [](const Vec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  auto list = nlohmann::ordered_json::array();
  for (const SetSummary& set : sets) {
    nlohmann::ordered_json row = {
        {"kind", kind_name(set.kind)}, {"name", set.name}, {"elements", set.num_elements}};
    if (set.kind == SetKind::Region) row["volume"] = set.measure;
    if (set.kind == SetKind::Patch || set.kind == SetKind::PatchGroup) row["area"] = set.measure;
    if (set.kind == SetKind::Curve) row["length"] = set.measure;
    row["centroid"] = vector(set.centroid);
    if (set.shape == SetShape::Plane) row["normal"] = vector(set.direction);
    if (set.shape == SetShape::Cylinder) {
      row["axis"] = vector(set.direction);
      row["radius"] = set.radius;
    }
    list.push_back(std::move(row));
  }
  return list.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string sets_to_text(const std::vector<SetSummary>& sets) {
  const auto vector = [](const Vec3& v) {
    return fmt::format("({:.4g} {:.4g} {:.4g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);
  };
  std::string text;
  for (const SetSummary& set : sets) {
    if (set.kind == SetKind::Curve || set.kind == SetKind::Corners) continue;
    const bool is_region = set.kind == SetKind::Region;
    text += fmt::format("  {:<10} {}: {} {}, {} {:.5g}, at {}", kind_name(set.kind), set.name,
                        set.num_elements, is_region ? "hexes" : "quads",
                        is_region ? "volume" : "area", set.measure, vector(set.centroid));
    if (set.shape == SetShape::Plane) text += ", normal " + vector(set.direction);
    if (set.shape == SetShape::Cylinder)
      text += fmt::format(", axis {}, radius {:.5g}", vector(set.direction), set.radius);
    text += "\n";
  }
  return text;
}

}  // namespace hexwright
