// Doubles the walls' quads. Copies go inwards; at a rim they go along the patch that the sheet ends
// in, whose quads and edges move with them.
#include "layers/sheet.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "fit/carve/visible_normal.h"
#include "fit/sheets/insert.h"
#include "mesh/quad.h"

namespace hexwright::layers {
namespace {

using relax::BoundaryEdgeId;

constexpr double kSameNormal = 0.94;    // cosine of 20 degrees: such faces count as one
constexpr double kMaxConvex = 1.5;      // offset over height at ridges; sharper ones are cut short
constexpr double kMaxConcave = 3;       // ... and in edges
constexpr double kLeastVisible = 1e-3;  // cosine

/// One region's part of the work.
class Inserter {
 public:
  Inserter(SheetMesh& result, const Similarity& frame, const LayersOptions& options, Skin& skin)
      : result_(result), mesh_(result.mesh), frame_(frame), options_(options), skin_(skin) {}

  /// False when vertices were found that no sheet can pass: they are taken out of the walls.
  bool run() {
    collect();
    if (plan_.sheet.quads.empty()) return true;
    const std::vector<VertId> blind = aim();
    if (!blind.empty()) return give_up(blind);
    const fitting::Insertion insertion = fitting::insert_sheet(mesh_, VertToHex(mesh_), plan_);
    if (insertion.copies.empty()) return give_up(insertion.stuck);
    relabel(insertion.copies);
    record(insertion.copies);
    return true;
  }

 private:
  bool give_up(const std::vector<VertId>& verts) {
    result_.left_out.push_back(
        {leave_out_at(mesh_, verts, skin_),
         fmt::format("no sheet of hexes fits at {} vertices, the first at {}; refine there, or "
                     "leave the patch out of the layers",
                     verts.size(), say_place(frame_, mesh_.positions[verts.front()]))});
    return false;
  }

  void collect() {
    for (QuadId q : skin_.quads.ids())
      if (skin_.is_wall(q)) {
        plan_.sheet.add_face(mesh_, skin_.faces[q.index()]);
        wall_quads_.push_back(q);
      }
    plan_.sheet.collect_verts();
    if (mesh_.region.empty()) return;
    for (std::int32_t tag : mesh_.region) plan_.takes_copy.push_back(tag == skin_.region);
  }

  Vec3 corner_normal(QuadId q, VertId v) const {
    const auto& quad = skin_.quads[q];
    const std::size_t k =
        static_cast<std::size_t>(std::find(quad.begin(), quad.end(), v) - quad.begin());
    const Vec3& o = mesh_.positions[v];
    return normalized(
        cross(mesh_.positions[quad[(k + 1) % 4]] - o, mesh_.positions[quad[(k + 3) % 4]] - o));
  }

  /// Directions of all copies. Returns the vertices whose faces are seen from nowhere.
  std::vector<VertId> aim() {
    std::vector<VertId> blind;
    for (VertId v : plan_.sheet.verts) {
      SheetVert vert;
      vert.wall = v;
      set_sizes(vert);
      set_normals(vert);
      const Vec3 slide = rim_direction(v);
      vert.is_rim = slide != Vec3{};
      const auto seen = fitting::find_visible_direction(vert.normals, 0.9999);
      const Vec3 direction = vert.is_rim ? slide : seen.direction;
      double cosine = seen.cosine;
      if (vert.is_rim)
        for (const Vec3& n : vert.normals) cosine = std::min(cosine, dot(n, slide));
      if (cosine < kLeastVisible) blind.push_back(v);
      vert.is_convex = is_convex(vert);
      vert.offset = direction *
                    std::min(1 / std::max(cosine, 1e-6), vert.is_convex ? kMaxConvex : kMaxConcave);
      plan_.directions.push_back(-direction);
      verts_.push_back(std::move(vert));
    }
    return blind;
  }

  void set_sizes(SheetVert& vert) const {
    double sum = 0;
    int count = 0;
    for (BoundaryEdgeId e : skin_.graph.edges(vert.wall)) {
      const auto& edge = skin_.graph.edge(e);
      bool is_of_wall = false;
      for (int k = 0; k < std::min(2, edge.num_quads); ++k)
        is_of_wall |= skin_.is_wall(edge.quads[k]);
      if (!is_of_wall) continue;
      sum += distance(mesh_.positions[edge.a], mesh_.positions[edge.b]);
      ++count;
    }
    vert.size = sum / std::max(1, count);
  }

  /// Faces that nearly agree are one smooth wall; its normal is the mean by angle.
  void set_normals(SheetVert& vert) const {
    std::vector<Vec3> normals;
    for (QuadId q : skin_.graph.quads(vert.wall))
      if (skin_.is_wall(q)) normals.push_back(-corner_normal(q, vert.wall));
    while (!normals.empty()) {
      const Vec3 seed = normals.front();
      Vec3 sum;
      std::vector<Vec3> rest;
      for (const Vec3& n : normals) {
        if (dot(n, seed) > kSameNormal)
          sum += n;
        else
          rest.push_back(n);
      }
      vert.normals.push_back(normalized(sum));
      normals = std::move(rest);
    }
  }

  bool is_convex(const SheetVert& vert) const {
    if (vert.normals.size() < 2) return false;
    for (QuadId q : skin_.graph.quads(vert.wall)) {
      if (!skin_.is_wall(q)) continue;
      Vec3 center;
      for (VertId v : skin_.quads[q]) center += mesh_.positions[v] * 0.25;
      for (const Vec3& n : vert.normals)
        if (dot(n, center - mesh_.positions[vert.wall]) > 0.1 * vert.size) return false;
    }
    return true;
  }

  PatchId patch_of(QuadId q) const { return layers::patch_of(mesh_, skin_, q); }

  /// Along the quads that are no walls, away from the wall: on the border of two patches along it.
  /// Zero where all are walls.
  Vec3 rim_direction(VertId v) const {
    Vec3 border, along, across;
    const Vec3& o = mesh_.positions[v];
    for (BoundaryEdgeId e : skin_.graph.edges(v)) {
      const auto& edge = skin_.graph.edge(e);
      const bool is_inner = std::none_of(edge.quads, edge.quads + std::min(2, edge.num_quads),
                                         [&](QuadId q) { return skin_.is_wall(q); });
      if (!is_inner) continue;
      const Vec3 d = normalized(mesh_.positions[edge.other(v)] - o);
      along += d;
      if (edge.num_quads == 2 && patch_of(edge.quads[0]) != patch_of(edge.quads[1])) border += d;
    }
    for (QuadId q : skin_.graph.quads(v)) {
      if (skin_.is_wall(q)) continue;
      Vec3 center;
      for (VertId w : skin_.quads[q]) center += mesh_.positions[w] * 0.25;
      across += normalized(center - o);
    }
    return normalized(border != Vec3{} ? border : along != Vec3{} ? along : across);
  }

  void relabel(const std::vector<VertId>& copies) {
    copy_of_.assign(mesh_.num_verts(), VertId{});
    for (std::size_t i = 0; i < copies.size(); ++i) copy_of_[plan_.sheet.verts[i]] = copies[i];
    auto& labels = mesh_.labels;
    for (QuadId q : skin_.quads.ids())
      if (skin_.label[q] >= 0 && !skin_.is_wall(q))
        for (VertId& v : labels.quads[static_cast<std::size_t>(skin_.label[q])].verts) v = moved(v);
    for (std::size_t i = 0; i < skin_.graph.num_edges(); ++i) {
      const auto& edge = skin_.graph.edge(BoundaryEdgeId(i));
      if (skin_.is_rim(edge)) add_rim_quad(edge);
    }
    move_edges();
  }
  VertId moved(VertId v) const { return copy_of_[v].is_valid() ? copy_of_[v] : v; }

  /// The sheet's own face between the wall and the patch that it ends in, of which it becomes part.
  void add_rim_quad(const relax::BoundaryGraph::Edge& edge) {
    const QuadId other = edge.quads[skin_.is_wall(edge.quads[0]) ? 1 : 0];
    if (skin_.label[other] < 0) return;
    const LabeledQuad& label = mesh_.labels.quads[static_cast<std::size_t>(skin_.label[other])];
    VertId a = edge.a, b = edge.b;
    for (std::size_t k = 0; k < 4; ++k)  // as the other quad, already moved, goes along the edge
      if (label.verts[k] == moved(b) && label.verts[(k + 1) % 4] == moved(a)) std::swap(a, b);
    mesh_.labels.quads.push_back({{a, b, moved(b), moved(a)}, label.patch});
  }

  /// Edges of no wall go with the copies; where one ends at a wall a piece is put in.
  void move_edges() {
    auto& edges = mesh_.labels.edges;
    const std::size_t count = edges.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto [a, b] = edges[i].verts;
      const BoundaryEdgeId e = skin_.graph.find_edge(a, b);
      if (!e.is_valid()) continue;
      const auto& edge = skin_.graph.edge(e);
      if (std::any_of(edge.quads, edge.quads + std::min(2, edge.num_quads),
                      [&](QuadId q) { return skin_.is_wall(q); }))
        continue;
      edges[i].verts = {moved(a), moved(b)};
      const CurveId curve = edges[i].curve;
      for (VertId v : {a, b})
        if (moved(v) != v) edges.push_back({{v, moved(v)}, curve});
    }
  }

  void record(const std::vector<VertId>& copies) {
    const std::size_t first = mesh_.num_hexes() - plan_.sheet.quads.size();
    for (std::size_t k = 0; k < wall_quads_.size(); ++k)
      result_.hexes.push_back(
          {HexId(first + k), skin_.spec[wall_quads_[k]], skin_.label[wall_quads_[k]]});
    for (std::size_t i = 0; i < verts_.size(); ++i) {
      verts_[i].inner = copies[i];
      verts_[i].spec = kNoSpec;
      for (QuadId q : skin_.graph.quads(verts_[i].wall))
        if (skin_.is_wall(q) && (verts_[i].spec == kNoSpec || skin_.spec[q] < verts_[i].spec))
          verts_[i].spec = skin_.spec[q];
      result_.verts.push_back(std::move(verts_[i]));
    }
  }

  SheetMesh& result_;
  HexMesh& mesh_;
  const Similarity& frame_;
  const LayersOptions& options_;
  Skin& skin_;
  fitting::SheetPlan plan_;
  std::vector<QuadId> wall_quads_;
  std::vector<SheetVert> verts_;
  IdVector<VertId, VertId> copy_of_;
};

/// Those of the vertices that are on a wall of the skin.
std::vector<VertId> on_walls(const std::vector<VertId>& verts, const Skin& skin) {
  std::vector<VertId> found;
  for (VertId v : verts)
    if (std::ranges::any_of(skin.graph.quads(v), [&](QuadId q) { return skin.is_wall(q); }))
      found.push_back(v);
  return found;
}

}  // namespace

SheetMesh insert_sheets(const HexMesh& mesh, const Similarity& frame, const WallPatches& patches,
                        const LayersOptions& options, const std::vector<VertId>& blocked) {
  SheetMesh result;
  result.mesh = mesh;
  result.wall_area.assign(patches.name.size(), 0);
  for (std::int32_t region : list_regions(mesh)) {
    Skin skin = make_skin(result.mesh, patches, region);
    for (QuadId q : skin.quads.ids())
      if (skin.is_wall(q))
        result.wall_area[patch_of(result.mesh, skin, q)] +=
            quad_area(result.mesh.positions, skin.quads[q]);
    const auto left_out = leave_out_walls(result.mesh, patches, options, frame, skin);
    result.left_out.insert(result.left_out.end(), left_out.begin(), left_out.end());
    if (const auto verts = on_walls(blocked, skin); !verts.empty())
      result.left_out.push_back(
          {leave_out_at(result.mesh, verts, skin),
           fmt::format("the layers cannot be made positive at {}; refine there, or leave the "
                       "patch out of the layers",
                       say_place(frame, mesh.positions[verts.front()]))});
    while (!Inserter(result, frame, options, skin).run()) {
    }
  }
  return result;
}

}  // namespace hexwright::layers
