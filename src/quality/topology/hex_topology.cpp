// Checks that need connectivity alone; hanging vertices, which need positions, are in
// hanging_verts.cpp.
#include "hexwright/quality/hex_topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "base/disjoint_sets.h"
#include "quality/topology/boundary_surface.h"
#include "quality/topology/hanging_verts.h"
#include "quality/topology/vert_links.h"

namespace hexwright {
namespace {

// "3 hexes use a vertex twice; the first is hex 17", or "1 hex uses ...".
std::string name(HexId h) { return "hex " + std::to_string(h.value()); }
std::string name(VertId v) { return "vertex " + std::to_string(v.value()); }
std::string name(const BoundaryEdge& e) {
  return "edge (" + std::to_string(e.verts[0].value()) + ", " + std::to_string(e.verts[1].value()) +
         ")";
}
std::string name(const HexMesh& mesh, HexFace face) {
  std::string text = "face (";
  for (VertId v : face_verts(mesh, face)) text += std::to_string(v.value()) + ", ";
  text.resize(text.size() - 2);
  return text + ") of " + name(face.hex);
}

void add_problem(TopologyReport& report, std::size_t count, const char* what,
                 const std::string& first) {
  report.problems.push_back(std::to_string(count) + " " + what + "; the first is " + first);
}

// Indices for which `holds` is true: how many, and the first.
struct Found {
  std::size_t count = 0;
  std::size_t first = 0;
};
template <class Predicate>
Found find_all(std::size_t size, Predicate holds) {
  const auto scan = [&](std::size_t begin, std::size_t end) {
    Found found;
    for (std::size_t i = begin; i < end; ++i)
      if (holds(i) && found.count++ == 0) found.first = i;
    return found;
  };
  return parallel_reduce(size, Found{}, scan, [](Found a, const Found& b) {
    return a.count > 0 ? Found{a.count + b.count, a.first} : b;
  });
}

bool has_repeated_vert(const std::array<VertId, 8>& hex) {
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = i + 1; j < 8; ++j)
      if (hex[i] == hex[j]) return true;
  return false;
}

void check_repeated_verts(const HexMesh& mesh, TopologyReport& report) {
  const Found found = find_all(
      mesh.num_hexes(), [&](std::size_t h) { return has_repeated_vert(mesh.hexes[HexId(h)]); });
  report.num_repeated_verts = found.count;
  if (found.count > 0)
    add_problem(report, found.count, "hex(es) use a vertex more than once",
                name(HexId(found.first)));
}

// Whether b runs through the vertices of a the other way round.
bool runs_opposite(const std::array<VertId, 4>& a, const std::array<VertId, 4>& b) {
  for (std::size_t shift = 0; shift < 4; ++shift)
    if (a[0] == b[shift])
      return a[1] == b[(shift + 3) % 4] && a[2] == b[(shift + 2) % 4] && a[3] == b[(shift + 1) % 4];
  return false;
}

bool has_face_opposite_to(const HexMesh& mesh, HexId h, const std::array<VertId, 4>& face) {
  for (int lf = 0; lf < 6; ++lf)
    if (runs_opposite(face, face_verts(mesh, {h, lf}))) return true;
  return false;
}

void check_faces(const HexMesh& mesh, const HexNeighbors& adjacency, TopologyReport& report) {
  if (!adjacency.non_conforming.empty()) {
    // Faces are listed once per hex: count distinct ones.
    std::vector<std::array<VertId, 4>> keys;
    for (const HexFace& face : adjacency.non_conforming) {
      keys.push_back(face_verts(mesh, face));
      std::sort(keys.back().begin(), keys.back().end());
    }
    std::sort(keys.begin(), keys.end());
    report.num_nonconforming_faces =
        static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
    add_problem(report, report.num_nonconforming_faces, "face(s) are shared by three or more hexes",
                name(mesh, adjacency.non_conforming.front()));
  }
  const auto is_misoriented = [&](std::size_t i) {
    const HexFace face{HexId(i / 6), static_cast<int>(i % 6)};
    const HexId other = adjacency.neighbor[face.hex][i % 6];
    return other.is_valid() && face.hex < other &&
           !has_face_opposite_to(mesh, other, face_verts(mesh, face));
  };
  const Found found = find_all(6 * mesh.num_hexes(), is_misoriented);
  report.num_misoriented_faces = found.count;
  if (found.count > 0)
    add_problem(report, found.count, "shared face(s) whose two hexes are not oriented alike",
                name(mesh, {HexId(found.first / 6), static_cast<int>(found.first % 6)}));
}

// Neighbours of h with a higher number that it meets in two or more faces.
std::size_t count_doublets(const std::array<HexId, 6>& neighbors, HexId h) {
  std::array<HexId, 6> sorted = neighbors;
  std::sort(sorted.begin(), sorted.end());
  std::size_t count = 0;
  for (std::size_t i = 1; i < 6; ++i)
    if (sorted[i] > h && sorted[i] == sorted[i - 1] && (i == 1 || sorted[i - 2] != sorted[i]))
      ++count;
  return count;
}

void check_doublets(const HexNeighbors& adjacency, TopologyReport& report) {
  std::optional<HexId> first;
  for (HexId h : adjacency.neighbor.ids()) {
    const std::size_t count = count_doublets(adjacency.neighbor[h], h);
    if (count > 0 && !first) first = h;
    report.num_doublets += count;
  }
  if (first)
    add_problem(report, report.num_doublets, "pair(s) of hexes share two or more faces",
                name(*first) + " with a neighbour");
}

void check_boundary(const BoundarySurface& boundary, TopologyReport& report) {
  const Found edges = find_all(boundary.edges.size(),
                               [&](std::size_t i) { return boundary.edges[i].num_quads != 2; });
  report.num_nonmanifold_edges = edges.count;
  if (edges.count > 0)
    add_problem(report, edges.count, "boundary edge(s) have other than two boundary quads",
                name(boundary.edges[edges.first]));
  const Found verts = find_all(boundary.verts.size(),
                               [&](std::size_t i) { return boundary.verts[i].num_fans != 1; });
  report.num_nonmanifold_verts = verts.count;
  if (verts.count > 0)
    add_problem(report, verts.count, "boundary vertex(es) where parts of the boundary touch",
                name(boundary.verts[verts.first].vert));
  report.num_boundary_quads = boundary.quads.size();
  report.num_boundary_components = boundary.num_components;
  report.boundary_euler_characteristic = static_cast<long>(boundary.verts.size()) -
                                         static_cast<long>(boundary.edges.size()) +
                                         static_cast<long>(boundary.quads.size());
}

/// Tells contact of bodies from hexes that do not fit together: bodies have a region of their own
/// each, and no vertex in common (which the levels of a grid, when they stand as regions, have).
class Bodies {
 public:
  explicit Bodies(const HexMesh& mesh) : mesh_(mesh), sets_(mesh.num_verts()) {
    for (const auto& hex : mesh.hexes)
      for (VertId v : hex) sets_.unite(hex[0].index(), v.index());
  }

  bool are_in_contact(HexId a, HexId b) {
    return mesh_.region[a] != mesh_.region[b] && body_of(a) != body_of(b);
  }

 private:
  std::size_t body_of(HexId h) { return sets_.find(mesh_.hexes[h][0].index()); }

  const HexMesh& mesh_;
  DisjointSets sets_;
};

/// Takes out of them what only touches another body, and returns the number of vertices that do.
std::size_t take_contacts(const HexMesh& mesh, const BoundarySurface& boundary,
                          std::vector<HangingVert>& hanging) {
  if (hanging.empty() || mesh.region.empty()) return 0;
  std::map<VertId, HexId> vert_to_hex;
  for (const HangingVert& h : hanging) vert_to_hex[h.vert];
  for (std::size_t q = 0; q < boundary.quads.size(); ++q)
    for (VertId v : boundary.quads[q])
      if (const auto it = vert_to_hex.find(v); it != vert_to_hex.end())
        it->second = boundary.faces[q].hex;
  Bodies bodies(mesh);
  std::set<VertId> contacts;
  std::erase_if(hanging, [&](const HangingVert& h) {
    const bool is_contact = bodies.are_in_contact(vert_to_hex[h.vert], h.face.hex);
    if (is_contact) contacts.insert(h.vert);
    return is_contact;
  });
  return contacts.size();
}

void check_hanging(const HexMesh& mesh, const BoundarySurface& boundary, TopologyReport& report) {
  auto hanging = find_hanging_verts(mesh, boundary);
  report.num_contact_verts = take_contacts(mesh, boundary, hanging);
  const auto is_same = [](const HangingVert& a, const HangingVert& b) { return a.vert == b.vert; };
  hanging.erase(std::unique(hanging.begin(), hanging.end(), is_same), hanging.end());
  for (const HangingVert& h : hanging) report.hanging_verts.push_back(h.vert);
  if (!hanging.empty())
    add_problem(report, hanging.size(), "vertex(es) lie inside an edge or face of another hex",
                name(hanging.front().vert) + " in " + name(mesh, hanging.front().face));
}

void check_links(const HexMesh& mesh, const BoundarySurface& boundary, TopologyReport& report) {
  // Links presume faces that are shared properly and vertices that differ.
  if (report.num_repeated_verts + report.num_nonconforming_faces > 0) return;
  const std::vector<VertId> singular = find_singular_verts(mesh, boundary);
  report.num_singular_verts = singular.size();
  if (!singular.empty())
    add_problem(report, singular.size(),
                "vertex(es) whose hexes form neither a ball nor a half ball around them",
                name(singular.front()));
}

std::size_t count_components(const HexNeighbors& adjacency) {
  DisjointSets sets(adjacency.neighbor.size());
  for (HexId h : adjacency.neighbor.ids())
    for (HexId other : adjacency.neighbor[h])
      if (other.is_valid()) sets.unite(h.index(), other.index());
  return sets.count();
}

}  // namespace

TopologyReport check_topology(const HexMesh& mesh) {
  TopologyReport report;
  report.num_hexes = mesh.num_hexes();
  report.num_verts = mesh.num_verts();
  check_repeated_verts(mesh, report);
  const HexNeighbors adjacency = compute_hex_neighbors(mesh);
  check_faces(mesh, adjacency, report);
  check_doublets(adjacency, report);
  const BoundarySurface boundary = make_boundary_surface(mesh, adjacency);
  check_boundary(boundary, report);
  check_links(mesh, boundary, report);
  check_hanging(mesh, boundary, report);
  report.num_components = count_components(adjacency);
  return report;
}

}  // namespace hexwright
