// Walls by the names of patches, and the walls that no sheet can run under.
#include "layers/walls.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "hexwright/base/name_pattern.h"
#include "hexwright/io/set_summary.h"
#include "hexwright/io/set_table.h"

#include "base/disjoint_sets.h"
#include "base/words.h"
#include "mesh/quad.h"

namespace hexwright::layers {
namespace {

using relax::BoundaryEdgeId;
using relax::BoundaryGraph;

// A sheet ends at an edge only where the mesh is no wider there than this: its last hex has both
// quads as faces.
constexpr double kWidestEnd = 165 * 3.14159265358979323846 / 180;

void sort_unique(std::vector<PatchId>& patches) {
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
}

/// Finds what is wrong with each wall of a skin.
class WallCheck {
 public:
  WallCheck(const HexMesh& mesh, const WallPatches& patches, const LayersOptions& options,
            const Similarity& frame, const Skin& skin)
      : mesh_(mesh),
        patches_(patches),
        options_(options),
        frame_(frame),
        skin_(skin),
        walls_(skin.quads.size()),
        is_shared_(mesh.num_verts(), 0) {
    unite();
    if (mesh.region.empty()) return;
    for (HexId h : mesh.hexes.ids())
      if (mesh.region[h] != skin.region)
        for (VertId v : mesh.hexes[h]) is_shared_[v] = 1;
  }

  /// By the first quad of the wall; the first fault in order of vertices and edges counts.
  std::map<std::size_t, LeftOut> run() {
    for (std::size_t i = 0; i < skin_.graph.num_edges(); ++i) check_edge(BoundaryEdgeId(i));
    for (VertId v : skin_.graph.verts()) check_vert(v);
    return std::move(faults_);
  }
  std::size_t wall_of(QuadId q) { return walls_.find(q.index()); }

 private:
  void unite() {
    for (VertId v : skin_.graph.verts()) {
      QuadId first;
      for (QuadId q : skin_.graph.quads(v)) {
        if (!skin_.is_wall(q)) continue;
        if (first.is_valid()) walls_.unite(first.index(), q.index());
        first = q;
      }
    }
  }

  PatchId patch_of(QuadId q) const { return layers::patch_of(mesh_, skin_, q); }
  std::string name_of(QuadId q) const {
    const PatchId p = patch_of(q);
    return p.is_valid() ? "'" + patches_.name[p] + "'" : "a side of the domain";
  }
  /// The sides of a domain have no layers.
  std::string remedy(QuadId other) const {
    return patch_of(other).is_valid() ? "give layers to " + name_of(other) + " too"
                                      : "move that side, or mesh one side of the surface only";
  }
  void add(QuadId q, std::string why) {
    faults_.try_emplace(wall_of(q), LeftOut{{}, std::move(why)});
  }

  void check_edge(BoundaryEdgeId e) {
    const auto& edge = skin_.graph.edge(e);
    for (QuadId q : {edge.quads[0], edge.quads[1]})
      if (edge.num_quads > 2 && skin_.is_wall(q))
        add(q, "more than two boundary quads share an edge at " + place(edge.a));
    if (edge.num_quads != 2) return;
    const QuadId a = edge.quads[0], b = edge.quads[1];
    if (skin_.is_wall(a) && skin_.is_wall(b)) {
      check_counts(a, b, edge.a);
    } else if (skin_.is_rim(edge)) {
      check_rim(edge, skin_.is_wall(a) ? a : b, skin_.is_wall(a) ? b : a);
    }
  }

  void check_counts(QuadId a, QuadId b, VertId v) {
    const auto count = [&](QuadId q) {
      return options_.specs[static_cast<std::size_t>(skin_.spec[q])].count;
    };
    if (count(a) == count(b)) return;
    add(a, fmt::format("{} asks for {} layers and {} for {}, but they meet at {}, where one "
                       "sheet runs; give both the same count",
                       name_of(a), count(a), name_of(b), count(b), place(v)));
  }

  void check_rim(const BoundaryGraph::Edge& edge, QuadId wall, QuadId other) {
    if (is_shared_[edge.a] || is_shared_[edge.b]) {
      add(wall, fmt::format("the wall ends at {}, where two regions are; {}", place(edge.a),
                            remedy(other)));
      return;
    }
    if (opening(edge, wall, other) <= kWidestEnd) return;
    add(wall, fmt::format("the mesh is wider than a corner where the wall meets {} at {}; {}",
                          name_of(other), place(edge.a), remedy(other)));
  }

  /// The angle at the edge on the mesh's side.
  double opening(const BoundaryGraph::Edge& edge, QuadId wall, QuadId other) const {
    const auto& p = mesh_.positions;
    const Vec3 n = quad_normal(p, skin_.quads[wall]), m = quad_normal(p, skin_.quads[other]);
    Vec3 center;
    for (VertId v : skin_.quads[other]) center += p[v] * 0.25;
    const Vec3 middle = (p[edge.a] + p[edge.b]) * 0.5;
    const double turn = std::acos(std::clamp(dot(n, m), -1.0, 1.0));
    constexpr double kPi = 3.14159265358979323846;
    return dot(n, center - middle) < 0 ? kPi - turn : kPi + turn;
  }

  /// Walls and other quads are one fan each, and at most one curve leaves through the others.
  void check_vert(VertId v) {
    QuadId wall;
    int num_rims = 0, num_curves = 0;
    for (QuadId q : skin_.graph.quads(v))
      if (skin_.is_wall(q)) wall = q;
    if (!wall.is_valid()) return;
    for (BoundaryEdgeId e : skin_.graph.edges(v)) {
      const auto& edge = skin_.graph.edge(e);
      if (edge.num_quads != 2) continue;
      if (skin_.is_rim(edge))
        ++num_rims;
      else if (!skin_.is_wall(edge.quads[0]) && patch_of(edge.quads[0]) != patch_of(edge.quads[1]))
        ++num_curves;
    }
    if (num_rims > 2)
      add(wall, "walls touch at a single vertex at " + place(v) +
                    "; give layers to the patches between them too");
    else if (num_curves > 1)
      add(wall, "several patches without layers meet the wall at " + place(v) +
                    "; give layers to all but two of them");
  }

  std::string place(VertId v) const { return say_place(frame_, mesh_.positions[v]); }

  const HexMesh& mesh_;
  const WallPatches& patches_;
  const LayersOptions& options_;
  const Similarity& frame_;
  const Skin& skin_;
  DisjointSets walls_;
  IdVector<VertId, char> is_shared_;
  std::map<std::size_t, LeftOut> faults_;
};

/// What a patch may be called by: "wall.1" is also in "wall".
std::vector<std::string> names_of(const SetTable& table, const NamedSet& patch) {
  std::vector<std::string> names = {patch.name, default_set_name(SetKind::Patch, patch.number)};
  for (const NamedSet& group : table.patch_groups)
    if (is_in_group(patch, group)) names.push_back(group.name);
  return names;
}

}  // namespace

std::string say_place(const Similarity& frame, const Vec3& unit) {
  return place(frame.to_world(unit));
}

WallPatches find_wall_patches(const HexMesh& mesh, const Similarity& frame,
                              const LayersOptions& options, LayersReport& report) {
  WallPatches patches;
  for (const LabeledQuad& quad : mesh.labels.quads)
    if (quad.patch.is_valid() && quad.patch.index() >= patches.name.size())
      patches.name.resize(quad.patch.index() + 1);
  patches.spec.assign(patches.name.size(), kNoSpec);
  SetTable table = make_set_table(mesh);
  name_by_place(to_world(mesh, frame), table);
  std::vector<char> is_matched(options.specs.size(), 0);
  for (const NamedSet& set : table.patches) {
    report.names.push_back(set.name);  // for people who asked for another
    if (set.number < 0) continue;
    const PatchId p(set.number);
    patches.name[p] = set.name;
    const std::vector<std::string> names = names_of(table, set);
    for (std::size_t s = 0; s < options.specs.size(); ++s) {
      if (std::none_of(names.begin(), names.end(), [&](const std::string& name) {
            return matches_pattern(options.specs[s].pattern, name);
          }))
        continue;
      is_matched[s] = 1;
      if (patches.spec[p] == kNoSpec) patches.spec[p] = static_cast<int>(s);
    }
  }
  for (std::size_t s = 0; s < options.specs.size(); ++s)
    if (!is_matched[s]) report.unmatched.push_back(options.specs[s].pattern);
  if (report.unmatched.empty()) report.names.clear();
  return patches;
}

std::vector<std::int32_t> list_regions(const HexMesh& mesh) {
  std::vector<std::int32_t> tags = mesh.region.raw();
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  if (tags.empty()) tags.push_back(0);
  return tags;
}

PatchId patch_of(const HexMesh& mesh, const Skin& skin, QuadId q) {
  const int label = skin.label[q];
  return label < 0 ? PatchId() : mesh.labels.quads[static_cast<std::size_t>(label)].patch;
}

Skin make_skin(const HexMesh& mesh, const WallPatches& patches, std::int32_t region) {
  std::map<std::array<VertId, 4>, int> quad_to_label;
  for (std::size_t i = 0; i < mesh.labels.quads.size(); ++i)
    quad_to_label.emplace(sorted(mesh.labels.quads[i].verts), static_cast<int>(i));
  Skin skin;
  skin.region = region;
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  const auto tag = [&](HexId h) { return mesh.region.empty() ? 0 : mesh.region[h]; };
  for (HexId h : mesh.hexes.ids()) {
    if (tag(h) != region) continue;
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      if (other.is_valid() && tag(other) == region) continue;
      skin.faces.push_back({h, lf});
      skin.quads.push_back(face_verts(mesh, {h, lf}));
      const auto found = quad_to_label.find(sorted(skin.quads.raw().back()));
      skin.label.push_back(found == quad_to_label.end() ? Skin::kNoLabel : found->second);
      const int label = skin.label.raw().back();
      skin.spec.push_back(
          label < 0 ? kNoSpec
                    : patches.spec_of(mesh.labels.quads[static_cast<std::size_t>(label)].patch));
    }
  }
  skin.graph = BoundaryGraph(mesh.num_verts(), skin.quads);
  return skin;
}

std::vector<LeftOut> leave_out_walls(const HexMesh& mesh, const WallPatches& patches,
                                     const LayersOptions& options, const Similarity& frame,
                                     Skin& skin) {
  WallCheck check(mesh, patches, options, frame, skin);
  auto faults = check.run();
  std::vector<char> is_faulty(skin.quads.size(), 0);
  for (QuadId q : skin.quads.ids()) {
    if (!skin.is_wall(q)) continue;
    const auto fault = faults.find(check.wall_of(q));
    if (fault == faults.end()) continue;
    is_faulty[q.index()] = 1;
    fault->second.patches.push_back(patch_of(mesh, skin, q));
  }
  for (QuadId q : skin.quads.ids())
    if (is_faulty[q.index()]) skin.spec[q] = kNoSpec;
  std::vector<LeftOut> left_out;
  for (auto& [wall, fault] : faults) {
    sort_unique(fault.patches);
    left_out.push_back(std::move(fault));
  }
  return left_out;
}

std::vector<PatchId> leave_out_at(const HexMesh& mesh, const std::vector<VertId>& verts,
                                  Skin& skin) {
  std::vector<PatchId> patches;
  std::vector<VertId> front = verts;
  while (!front.empty()) {
    const VertId v = front.back();
    front.pop_back();
    for (QuadId q : skin.graph.quads(v)) {
      if (!skin.is_wall(q)) continue;
      skin.spec[q] = kNoSpec;
      patches.push_back(patch_of(mesh, skin, q));
      for (VertId w : skin.quads[q]) front.push_back(w);
    }
  }
  sort_unique(patches);
  return patches;
}

}  // namespace hexwright::layers
