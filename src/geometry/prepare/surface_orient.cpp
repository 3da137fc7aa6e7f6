// Flood fill for agreement inside components, areas for which way a repaired one looks, winding
// numbers for what lies inside what, and signed volumes for which way is out.
#include "geometry/prepare/surface_orient.h"

#include <algorithm>
#include <optional>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/surface_tree.h"

#include "geometry/topology/surface_edges.h"
#include "geometry/tree/triangle_math.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// A part is inside another when all of this many points of it are.
constexpr std::size_t kNumProbes = 9;
constexpr std::size_t kMaxNestingParts = 3000;  ///< above, the quadratic nesting test is left out
constexpr double kInwardScore = -0.05;          ///< an open part below this points inwards

struct Part {
  TriMesh mesh;  // own triangles over the shared vertex numbers of the whole, compacted
  std::vector<TriId> tris;
  Box3 box;
  bool is_closed = true;
  bool was_repaired = false;
  double volume = 0;
  std::vector<int> containers;  // closed parts around this one
};

void turn(std::array<VertId, 3>& tri) { std::swap(tri[1], tri[2]); }

/// Components across edges of exactly two triangles, and whether each triangle must turn to agree
/// with the first of its component.
struct Agreement {
  std::vector<int> tri_to_part;
  std::vector<char> must_turn;
  std::size_t num_twisted_edges = 0;
  int num_parts = 0;
};

Agreement find_agreement(const TriMesh& mesh, const SurfaceEdges& edges) {
  // Neighbour lists across two-triangle edges; three per triangle at most.
  struct Link {
    int tri = -1;
    bool agrees = true;
  };
  std::vector<std::array<Link, 3>> links(mesh.num_tris());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto s = edges.sides_of(e);
    if (s.size() != 2) continue;
    const bool agrees = s[0].is_forward != s[1].is_forward;
    links[s[0].tri.index()][static_cast<std::size_t>(s[0].k)] = {s[1].tri.value(), agrees};
    links[s[1].tri.index()][static_cast<std::size_t>(s[1].k)] = {s[0].tri.value(), agrees};
  }
  Agreement result;
  result.tri_to_part.assign(mesh.num_tris(), -1);
  result.must_turn.assign(mesh.num_tris(), 0);
  std::vector<std::size_t> queue;
  std::size_t num_twisted = 0;
  for (std::size_t first = 0; first < mesh.num_tris(); ++first) {
    if (result.tri_to_part[first] >= 0) continue;
    const int part = result.num_parts++;
    result.tri_to_part[first] = part;
    queue = {first};
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const Link& link : links[queue[head]]) {
        if (link.tri < 0) continue;
        const auto next = static_cast<std::size_t>(link.tri);
        const char turned = result.must_turn[queue[head]] ^ char(!link.agrees);
        if (result.tri_to_part[next] < 0) {
          result.tri_to_part[next] = part;
          result.must_turn[next] = turned;
          queue.push_back(next);
        } else {
          num_twisted += result.must_turn[next] != turned;
        }
      }
  }
  result.num_twisted_edges = num_twisted / 2;  // seen from both sides
  return result;
}

/// Orientation goes by area, not by count: a fine patch must not outvote the large rest.
double area(const TriMesh& mesh, TriId t) {
  const auto c = mesh.corners(t);
  return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
}

/// Lets the larger area keep its orientation in each part; returns which parts were inconsistent.
std::vector<char> prefer_majority(const TriMesh& mesh, Agreement& agreement) {
  const auto num_parts = static_cast<std::size_t>(agreement.num_parts);
  std::vector<double> turned(num_parts, 0), kept(num_parts, 0);
  std::vector<char> is_mixed(num_parts, 0), has_turned(num_parts, 0), has_kept(num_parts, 0);
  for (TriId t : mesh.tris.ids()) {
    const auto part = static_cast<std::size_t>(agreement.tri_to_part[t.index()]);
    const bool turns = agreement.must_turn[t.index()];
    (turns ? turned : kept)[part] += area(mesh, t);
    (turns ? has_turned : has_kept)[part] = 1;
  }
  for (TriId t : mesh.tris.ids()) {
    const auto part = static_cast<std::size_t>(agreement.tri_to_part[t.index()]);
    if (turned[part] > kept[part]) agreement.must_turn[t.index()] ^= 1;
  }
  for (std::size_t p = 0; p < num_parts; ++p) is_mixed[p] = has_turned[p] && has_kept[p];
  return is_mixed;
}

/// A part is closed when every edge has an even number of its own triangles: closed parts that
/// touch others along an edge still count as closed.
std::vector<Part> split_parts(const TriMesh& mesh, const SurfaceEdges& edges,
                              const Agreement& agreement, const std::vector<char>& was_mixed) {
  std::vector<Part> parts(static_cast<std::size_t>(agreement.num_parts));
  const auto part_of = [&](TriId t) -> Part& {
    return parts[static_cast<std::size_t>(agreement.tri_to_part[t.index()])];
  };
  for (TriId t : mesh.tris.ids()) part_of(t).tris.push_back(t);
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const auto& side : edges.sides_of(e)) {
      std::size_t own = 0;
      for (const auto& s : edges.sides_of(e)) own += &part_of(s.tri) == &part_of(side.tri);
      if (own % 2 == 1) part_of(side.tri).is_closed = false;
    }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Part& part = parts[i];
    part.was_repaired = was_mixed[i];
    for (TriId t : part.tris) {
      std::array<VertId, 3> tri;
      for (std::size_t k = 0; k < 3; ++k)
        tri[k] = part.mesh.positions.push_back(mesh.positions[mesh.tris[t][k]]);
      part.mesh.tris.push_back(tri);
    }
    part.box = bounding_box(part.mesh);
    part.volume = enclosed_volume(part.mesh);
  }
  return parts;
}

bool box_inside(const Box3& inner, const Box3& outer) {
  return outer.contains(inner.lo) && outer.contains(inner.hi);
}

/// Sampled: exact for parts that do not cross each other, which is the only case that has an
/// answer.
bool is_inside(const Part& part, const SurfaceTree& other) {
  const std::size_t count = part.mesh.num_tris();
  for (std::size_t i = 0; i < std::min(kNumProbes, count); ++i) {
    const auto c = part.mesh.corners(TriId(i * count / std::min(kNumProbes, count)));
    // 0.9 to 1.1 for either orientation; parts that only touch lie between.
    if (std::abs(other.winding_number((c[0] + c[1] + c[2]) / 3)) < 0.75) return false;
  }
  return true;
}

/// Which closed parts hold which others, by sampled winding numbers; quadratic in the parts, but
/// boxes rule out nearly all pairs.
void find_containers(std::vector<Part>& parts, const Context& context) {
  if (parts.size() < 2 || parts.size() > kMaxNestingParts) return;
  for (std::size_t outer = 0; outer < parts.size(); ++outer) {
    if (!parts[outer].is_closed) continue;
    context.check_cancelled();
    std::optional<SurfaceTree> tree;
    for (std::size_t inner = 0; inner < parts.size(); ++inner) {
      if (inner == outer || !box_inside(parts[inner].box, parts[outer].box)) continue;
      if (!tree) tree.emplace(parts[outer].mesh);
      if (is_inside(parts[inner], *tree))
        parts[inner].containers.push_back(static_cast<int>(outer));
    }
  }
}

/// Mean over the part of its own winding number on the surface itself: +1/2 for a closed outward
/// part, -1/2 for an inward one, 0 for a flat sheet.
double outward_score(const Part& part) {
  const SurfaceTree tree(part.mesh);
  const std::size_t count = std::min<std::size_t>(part.mesh.num_tris(), 200);
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const TriId t(i * part.mesh.num_tris() / count);
    const auto c = part.mesh.corners(t);
    const double a = area(part.mesh, t);
    const Vec3 center = (c[0] + c[1] + c[2]) / 3, step = tree.normal(t) * (1e-3 * std::sqrt(a));
    sum += a * 0.5 * (tree.winding_number(center + step) + tree.winding_number(center - step));
    weight += a;
  }
  return weight > 0 ? sum / weight : 0;
}

/// Which parts to turn as a whole.
std::vector<char> choose_turns(const std::vector<Part>& parts) {
  std::vector<char> turns(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {  // outermost first: they decide for the rest
    const Part& part = parts[i];
    if (!part.containers.empty()) continue;
    turns[i] = part.is_closed ? part.volume < 0 : outward_score(part) < kInwardScore;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    for (int c : part.containers) {
      const auto outer = static_cast<std::size_t>(c);
      if (!parts[outer].containers.empty()) continue;
      turns[i] = turns[outer];
      break;
    }
    // A repaired part has no trustworthy orientation of its own: shells alternate.
    if (part.is_closed && part.was_repaired && !part.containers.empty())
      turns[i] = (part.volume > 0) == (part.containers.size() % 2 == 1);
  }
  return turns;
}

}  // namespace

Orientation orient_surface(TriMesh& mesh, const Context& context) {
  const SurfaceEdges edges = compute_surface_edges(mesh);
  Agreement agreement = find_agreement(mesh, edges);
  const std::vector<char> was_mixed = prefer_majority(mesh, agreement);
  const auto must_turn = [&](TriId t) {
    const auto part = static_cast<std::size_t>(agreement.tri_to_part[t.index()]);
    return was_mixed[part] && agreement.must_turn[t.index()];
  };
  TriMesh agreed = mesh;
  for (TriId t : mesh.tris.ids())
    if (must_turn(t)) turn(agreed.tris[t]);
  std::vector<Part> parts = split_parts(agreed, edges, agreement, was_mixed);
  find_containers(parts, context);
  const std::vector<char> turns = choose_turns(parts);

  Orientation result;
  result.num_parts = parts.size();
  result.num_twisted_edges = agreement.num_twisted_edges;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    for (TriId t : part.tris) {
      if (must_turn(t) == (turns[i] != 0)) continue;
      turn(mesh.tris[t]);
      result.num_repaired += part.was_repaired;
    }
    result.num_turned_parts += turns[i] && !part.was_repaired;
  }
  return result;
}

}  // namespace hexwright
