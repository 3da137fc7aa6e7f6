// Edges and stars of boundary quads by sorting half-edges.
#include "relax/kernel/boundary_quads.h"

#include <algorithm>

namespace hexwright::relax {

IdVector<VertId, double> compute_edge_lengths(IdSpan<VertId, const Vec3> positions,
                                              IdSpan<QuadId, const std::array<VertId, 4>> quads) {
  IdVector<VertId, double> length(positions.size(), 0.0);
  IdVector<VertId, double> count(positions.size(), 0.0);
  for (const auto& quad : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId a = quad[k], b = quad[(k + 1) % 4];
      const double d = distance(positions[a], positions[b]);
      length[a] += d;
      length[b] += d;
      count[a] += 1;
      count[b] += 1;
    }
  for (VertId v : length.ids())
    if (count[v] > 0) length[v] /= count[v];
  return length;
}

namespace {

struct HalfEdge {
  VertId a, b;  // a < b
  QuadId quad;
  int side;
};

/// Sorted by (a, b, quad). Linear: a bucket per vertex, and few half-edges in each.
std::vector<HalfEdge> sorted_half_edges(std::size_t num_verts,
                                        IdSpan<QuadId, const std::array<VertId, 4>> quads) {
  const auto visit = [&](auto&& take) {
    for (QuadId q : quads.ids())
      for (int k = 0; k < 4; ++k) {
        const VertId v = quads[q][static_cast<std::size_t>(k)];
        const VertId w = quads[q][static_cast<std::size_t>((k + 1) % 4)];
        take(HalfEdge{std::min(v, w), std::max(v, w), q, k});
      }
  };
  std::vector<std::size_t> offset(num_verts + 1, 0);
  visit([&](const HalfEdge& he) { ++offset[he.a.index() + 1]; });
  for (std::size_t v = 0; v < num_verts; ++v) offset[v + 1] += offset[v];
  std::vector<HalfEdge> half_edges(4 * quads.size());
  auto next = offset;
  visit([&](const HalfEdge& he) { half_edges[next[he.a.index()]++] = he; });
  // A bucket is filled in order of its quads; a stable order by b keeps that.
  for (std::size_t v = 0; v < num_verts; ++v)
    for (std::size_t i = offset[v] + 1; i < offset[v + 1]; ++i)
      for (std::size_t j = i; j > offset[v] && half_edges[j].b < half_edges[j - 1].b; --j)
        std::swap(half_edges[j], half_edges[j - 1]);
  return half_edges;
}

}  // namespace

BoundaryGraph::BoundaryGraph(std::size_t num_verts,
                             IdSpan<QuadId, const std::array<VertId, 4>> quads)
    : quad_edges_(quads.size()), edge_offset_(num_verts + 1, 0), quad_offset_(num_verts + 1, 0) {
  for (const HalfEdge& he : sorted_half_edges(num_verts, quads)) {
    const bool is_new =
        edges_.empty() || edges_.raw().back().a != he.a || edges_.raw().back().b != he.b;
    if (is_new) edges_.push_back({he.a, he.b, {}, 0});
    Edge& edge = edges_.raw().back();
    if (edge.num_quads < 2) edge.quads[edge.num_quads] = he.quad;
    ++edge.num_quads;
    quad_edges_[he.quad][static_cast<std::size_t>(he.side)] = BoundaryEdgeId(edges_.size() - 1);
  }
  index_stars(quads);
}

void BoundaryGraph::index_stars(IdSpan<QuadId, const std::array<VertId, 4>> quads) {
  for (const Edge& edge : edges_)
    for (VertId v : {edge.a, edge.b}) ++edge_offset_[v.index() + 1];
  for (const auto& quad : quads)
    for (VertId v : quad) ++quad_offset_[v.index() + 1];
  for (std::size_t v = 0; v + 1 < quad_offset_.size(); ++v) {
    if (quad_offset_[v + 1] > 0) verts_.push_back(VertId(v));
    edge_offset_[v + 1] += edge_offset_[v];
    quad_offset_[v + 1] += quad_offset_[v];
  }
  neighbors_.resize(edge_offset_.back());
  star_edges_.resize(edge_offset_.back());
  star_quads_.resize(quad_offset_.back());
  auto next = edge_offset_;
  const auto add = [&](VertId v, VertId w, BoundaryEdgeId e) {
    neighbors_[next[v.index()]] = w;
    star_edges_[next[v.index()]++] = e;
  };
  // Edges are sorted by (a, b): smaller neighbours of a vertex come first, then larger ones.
  for (BoundaryEdgeId e : edges_.ids()) add(edges_[e].b, edges_[e].a, e);
  for (BoundaryEdgeId e : edges_.ids()) add(edges_[e].a, edges_[e].b, e);
  next = quad_offset_;
  for (QuadId q : quads.ids())
    for (VertId v : quads[q]) star_quads_[next[v.index()]++] = q;
}

std::span<const VertId> BoundaryGraph::neighbors(VertId v) const {
  return {neighbors_.data() + edge_offset_[v.index()],
          neighbors_.data() + edge_offset_[v.index() + 1]};
}

std::span<const BoundaryEdgeId> BoundaryGraph::edges(VertId v) const {
  return {star_edges_.data() + edge_offset_[v.index()],
          star_edges_.data() + edge_offset_[v.index() + 1]};
}

std::span<const QuadId> BoundaryGraph::quads(VertId v) const {
  return {star_quads_.data() + quad_offset_[v.index()],
          star_quads_.data() + quad_offset_[v.index() + 1]};
}

BoundaryEdgeId BoundaryGraph::find_edge(VertId a, VertId b) const {
  const auto candidates = neighbors(a);
  const auto it = std::lower_bound(candidates.begin(), candidates.end(), b);
  if (it == candidates.end() || *it != b) return {};
  return edges(a)[static_cast<std::size_t>(it - candidates.begin())];
}

}  // namespace hexwright::relax
