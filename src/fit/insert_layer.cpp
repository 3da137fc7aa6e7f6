#include "fit/insert_layer.h"

#include <limits>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

#include "fit/set_check.h"

namespace hexwright::fitting {
namespace {

// Copies the layer's vertices, moves them inwards and thins the layer where it does not fit.
class LayerBuilder {
 public:
  LayerBuilder(FitState& state, const std::vector<char>& in_set,
               const IdVector<VertId, Vec3>& directions, const LayerOptions& options)
      : state_(state),
        mesh_(state.mesh),
        in_set_(in_set),
        directions_(directions),
        options_(options) {}

  LayerResult build() {
    find_faces();
    add_copies();
    result_.first_new_hex = HexId(mesh_.num_hexes());
    result_.num_new_hexes = faces_.size();
    add_hexes();
    place_copies();
    result_.is_valid = thin();
    return std::move(result_);
  }

 private:
  bool is_fixed(const std::array<VertId, 4>& quad) const {
    for (VertId v : quad)
      if (state_.move[v] == MoveIn::Space) return false;
    return true;
  }

  void find_faces() {
    for (HexId h : mesh_.hexes.ids()) {
      if (!in_set_[h.index()]) continue;
      for (int lf = 0; lf < 6; ++lf) {
        const HexId other = state_.neighbors.neighbor[h][static_cast<std::size_t>(lf)];
        if (other.is_valid() ? in_set_[other.index()] != 0 : !options_.on_outer_boundary) continue;
        const auto quad = face_verts(mesh_, {h, lf});
        if (!other.is_valid() && is_fixed(quad)) continue;
        faces_.push_back(quad);
        if (!mesh_.region.empty()) regions_.push_back(mesh_.region[h]);
      }
    }
  }

  void add_copies() {
    result_.copy.resize(mesh_.num_verts());
    for (const auto& quad : faces_)
      for (VertId v : quad) {
        if (result_.copy[v].is_valid()) continue;
        verts_.push_back(v);
        result_.copy[v] = mesh_.positions.push_back(mesh_.positions[v]);
      }
  }

  // The set takes the copies; each face becomes a hex between copies and originals.
  void add_hexes() {
    const auto& copy = result_.copy;
    for (VertId v : verts_)
      for (const HexCorner& corner : state_.vert_to_hex[v])
        if (in_set_[corner.hex.index()])
          mesh_.hexes[corner.hex][static_cast<std::size_t>(corner.lv)] = copy[v];
    new_hexes_of_.resize(result_.copy.size());
    for (const auto& q : faces_) {
      const HexId h = mesh_.hexes.push_back(
          {copy[q[0]], copy[q[1]], copy[q[2]], copy[q[3]], q[0], q[1], q[2], q[3]});
      for (VertId v : q) new_hexes_of_[v].push_back(h);
    }
    for (std::int32_t region : regions_) mesh_.region.push_back(region);
  }

  // Shortest edge at the vertex before the layer came; hexes of the set still have v's old place.
  double shortest_edge(VertId v) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const HexStar& star : state_.stars[v])
      for (std::size_t k = 0; k < 3; ++k)
        shortest = std::min(shortest, distance(mesh_.positions[star[k]], mesh_.positions[v]));
    return shortest;
  }

  void place(VertId v) {
    mesh_.positions[result_.copy[v]] = mesh_.positions[v] - thickness_[v] * directions_[v];
  }

  void place_copies() {
    thickness_.resize(result_.copy.size(), 0);
    for (VertId v : verts_) thickness_[v] = options_.thickness * shortest_edge(v);
    for (VertId v : verts_) place(v);
  }

  // Shrinks the layer at the vertices of failing hexes; only their surroundings are checked again.
  bool thin() {
    std::vector<VertId> to_check = verts_;
    std::vector<HexId> hexes;
    IdVector<VertId, char> is_thinned(result_.copy.size(), 0);
    IdVector<VertId, VertId> original(mesh_.num_verts());
    for (VertId v : verts_) original[result_.copy[v]] = v;
    for (int round = 0; round < 60; ++round) {
      collect_hexes(to_check, hexes);
      std::vector<char> fails(hexes.size());
      parallel_for(
          hexes.size(),
          [&](std::size_t i) {
            fails[i] = !(scaled_jacobian(mesh_.corners(hexes[i])) > options_.least_jacobian);
          },
          256);
      to_check.clear();
      for (std::size_t i = 0; i < hexes.size(); ++i) {
        if (!fails[i]) continue;
        for (VertId u : mesh_.hexes[hexes[i]]) {
          const VertId v = original[u];
          if (!v.is_valid() || is_thinned[v]) continue;
          is_thinned[v] = 1;
          to_check.push_back(v);
        }
        if (to_check.empty()) return false;  // a hex fails that has no vertex to move
      }
      if (to_check.empty()) return true;
      for (VertId v : to_check) {
        is_thinned[v] = 0;
        thickness_[v] *= 0.6;
        place(v);
      }
    }
    return false;
  }

  // The hexes that use a copy of one of the vertices, each once.
  void collect_hexes(const std::vector<VertId>& verts, std::vector<HexId>& hexes) const {
    hexes.clear();
    for (VertId v : verts) {
      for (const HexCorner& corner : state_.vert_to_hex[v])
        if (in_set_[corner.hex.index()]) hexes.push_back(corner.hex);
      hexes.insert(hexes.end(), new_hexes_of_[v].begin(), new_hexes_of_[v].end());
    }
    std::sort(hexes.begin(), hexes.end());
    hexes.erase(std::unique(hexes.begin(), hexes.end()), hexes.end());
  }

  FitState& state_;
  HexMesh& mesh_;
  const std::vector<char>& in_set_;
  const IdVector<VertId, Vec3>& directions_;
  const LayerOptions& options_;
  std::vector<std::array<VertId, 4>> faces_;  // outward of the set, by the old vertices
  std::vector<std::int32_t> regions_;         // per face, when the mesh has regions
  std::vector<VertId> verts_;                 // the layer's vertices, in order of appearance
  IdVector<VertId, std::vector<HexId>> new_hexes_of_;
  IdVector<VertId, double> thickness_;
  LayerResult result_;
};

}  // namespace

LayerResult insert_layer(FitState& state, const std::vector<char>& in_set,
                         const IdVector<VertId, Vec3>& directions, const LayerOptions& options) {
  return LayerBuilder(state, in_set, directions, options).build();
}

void pad_boundary(FitState& state) {
  const std::vector<char> all(state.mesh.num_hexes(), 1);
  SetCheck check(state.mesh, state.vert_to_hex, state.neighbors, true);
  IdVector<VertId, Vec3> directions(state.num_verts());
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v)) continue;
    const VisibleDirection visible = check.direction(v, all);
    if (!(visible.cosine > 0)) {
      throw Error(ErrorCode::BadGeometry,
                  "no direction sees all boundary faces around the vertex; thicken the mesh there "
                  "or carve it anew",
                  "vertex " + std::to_string(v.value()));
    }
    directions[v] = visible.direction;
  }
  const LayerResult layer = insert_layer(state, all, directions, {});
  if (!layer.is_valid)
    throw Error(ErrorCode::BadGeometry, "the boundary layer cannot be made thin enough");
  state.rebuild();
}

}  // namespace hexwright::fitting
