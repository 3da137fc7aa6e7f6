// What the nodes of a set form is asked of the hexes around them.
#include "io/content/label_collector.h"

#include <algorithm>

#include "hexwright/base/cancel.h"
#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::io {
namespace {

/// Faces and edges of hexes whose nodes are all in a set.
struct Formed {
  std::vector<std::array<VertId, 4>> boundary;  // faces, each once
  std::set<std::array<VertId, 2>> edges;
  bool has_hex = false;
  std::size_t on_faces = 0, on_boundary = 0, on_edges = 0;  // how many nodes such elements have
};

class NodeSetReader {
 public:
  explicit NodeSetReader(const VolumeFile& file) {
    mesh_.positions = file.positions;
    mesh_.hexes = file.hexes;
    vert_to_hex_ = VertToHex(mesh_);
    neighbors_ = compute_hex_neighbors(mesh_);
    marks_ = IdVector<VertId, char>(mesh_.num_verts(), 0);
  }

  /// The vertices of the set that hexes have, increasing, each once.
  std::vector<VertId> on_hexes(std::vector<VertId> verts) const {
    std::sort(verts.begin(), verts.end());
    verts.erase(std::unique(verts.begin(), verts.end()), verts.end());
    std::erase_if(verts, [&](VertId v) { return vert_to_hex_[v].empty(); });
    return verts;
  }

  Formed form(const std::vector<VertId>& verts) {
    Formed formed;
    for (VertId v : verts) marks_[v] = kInSet;
    CancelCheck check_cancelled;
    for (VertId v : verts) {
      check_cancelled();
      for (const HexCorner& corner : vert_to_hex_[v]) visit(v, corner.hex, formed);
    }
    for (VertId v : verts) {
      formed.on_faces += (marks_[v] & kOnFace) != 0;
      formed.on_boundary += (marks_[v] & kOnBoundary) != 0;
      formed.on_edges += (marks_[v] & kOnEdge) != 0;
      marks_[v] = 0;
    }
    return formed;
  }

 private:
  static constexpr char kInSet = 1, kOnEdge = 2, kOnFace = 4, kOnBoundary = 8;

  template <class Verts>
  bool all_in_set(const Verts& verts) const {
    return std::all_of(verts.begin(), verts.end(), [&](VertId v) { return marks_[v] != 0; });
  }
  void mark(const auto& verts, char bits) {
    for (VertId v : verts) marks_[v] = static_cast<char>(marks_[v] | bits);
  }

  /// Elements of a hex are visited from their lowest vertex.
  void visit(VertId v, HexId h, Formed& formed) {
    formed.has_hex = formed.has_hex || all_in_set(mesh_.hexes[h]);
    for (const auto& edge : kHexEdges) {
      std::array<VertId, 2> ends = {mesh_.hexes[h][static_cast<std::size_t>(edge[0])],
                                    mesh_.hexes[h][static_cast<std::size_t>(edge[1])]};
      std::sort(ends.begin(), ends.end());
      if (ends[0] != v || marks_[ends[1]] == 0) continue;
      mark(ends, kOnEdge);
      formed.edges.insert(ends);
    }
    for (int lf = 0; lf < 6; ++lf) {
      const auto verts = face_verts(mesh_, {h, lf});
      if (*std::min_element(verts.begin(), verts.end()) != v || !all_in_set(verts)) continue;
      mark(verts, kOnFace);
      if (neighbors_.neighbor[h][static_cast<std::size_t>(lf)].is_valid()) continue;
      mark(verts, kOnBoundary);
      formed.boundary.push_back(verts);
    }
  }

  HexMesh mesh_;
  VertToHex vert_to_hex_;
  HexNeighbors neighbors_;
  IdVector<VertId, char> marks_;
};

std::string capitals(std::string name) {
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return name;
}

template <class Verts>
Verts sorted(Verts verts) {
  std::sort(verts.begin(), verts.end());
  return verts;
}

}  // namespace

template <class Verts>
void LabelCollector::Elements<Verts>::add(const std::string& set, const Verts& verts) {
  if (!seen.insert(sorted(verts)).second) return;
  const auto next = static_cast<std::int64_t>(set_to_tag.size()) + 1;
  list.emplace_back(verts, set_to_tag.try_emplace(set, next).first->second);
}

template <class Verts>
std::vector<std::int32_t> LabelCollector::Elements<Verts>::numbers(SetKind kind,
                                                                   SetNames& names) const {
  std::map<std::int64_t, std::string> tags;
  for (const auto& [set, tag] : set_to_tag) tags[tag] = set;
  const auto tag_to_number = number_tags(kind, tags, names);
  std::vector<std::int32_t> numbers;
  for (const auto& [verts, tag] : list) numbers.push_back(tag_to_number.at(tag));
  return numbers;
}

void LabelCollector::add_quad(const std::string& set, const std::array<VertId, 4>& verts) {
  quads_.add(set, verts);
}

void LabelCollector::add_edge(const std::string& set, const std::array<VertId, 2>& verts) {
  edges_.add(set, verts);
}

void LabelCollector::add_node_set(const std::string& name, std::vector<VertId> verts) {
  node_sets_.emplace_back(name, std::move(verts));
}

/// In capitals, each also with what is put behind it for the nodes.
std::set<std::string> LabelCollector::names_of_elements() const {
  std::set<std::string> names;
  const auto add = [&](const auto& elements) {
    for (const auto& [set, tag] : elements.set_to_tag) {
      names.insert(capitals(set));
      names.insert(capitals(set) + "_NODES");
    }
  };
  add(quads_);
  add(edges_);
  return names;
}

void LabelCollector::read_node_sets() {
  if (node_sets_.empty() || file_.hexes.empty()) return;
  NodeSetReader reader(file_);
  const auto known = names_of_elements();
  for (const auto& [name, all_verts] : node_sets_) {
    const auto verts = reader.on_hexes(all_verts);
    if (verts.empty() || known.contains(capitals(name))) continue;
    const Formed formed = reader.form(verts);
    if (formed.has_hex) {
      ++file_.num_others;
      continue;
    }
    if (capitals(name) == default_set_name(SetKind::Corners, -1) || formed.edges.empty())
      corners_.insert(verts.begin(), verts.end());
    else if (formed.on_boundary == verts.size())
      for (const auto& quad : formed.boundary) add_quad(name, quad);
    else if (formed.on_edges == verts.size() && 2 * formed.on_faces <= verts.size())
      for (const auto& edge : formed.edges) add_edge(name, edge);
    else
      ++file_.num_others;
  }
}

void LabelCollector::settle(SetNames& names) {
  read_node_sets();
  const auto patches = quads_.numbers(SetKind::Patch, names);
  for (std::size_t q = 0; q < patches.size(); ++q)
    file_.labels.quads.push_back({quads_.list[q].first, PatchId(patches[q])});
  const auto curves = edges_.numbers(SetKind::Curve, names);
  for (std::size_t e = 0; e < curves.size(); ++e)
    file_.labels.edges.push_back({edges_.list[e].first, CurveId(curves[e])});
  file_.labels.corners.assign(corners_.begin(), corners_.end());
}

}  // namespace hexwright::io
