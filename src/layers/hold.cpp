// What the labels and the faces around a vertex tell of the surface there.
#include "layers/hold.h"

#include <algorithm>

#include "layers/walls.h"
#include "mesh/quad.h"

namespace hexwright::layers {
namespace {

using namespace relax;

constexpr double kFlat = 1e-4;      // radians: boundary faces that agree so well are one plane
constexpr double kOnePlane = 0.99;  // cosine, of the faces of a box around

struct BoundaryVert {
  Vec3 normal;
  bool is_flat = true;
  bool is_labelled = false;   // by a quad
  std::vector<Vec3> planes;   // of quads without a label
  std::vector<VertId> along;  // labelled edges
};

class Holder {
 public:
  explicit Holder(FitState& state)
      : state_(state), slides_(state.num_verts(), 0), verts_(state.num_verts()) {}

  IdVector<VertId, char> run() {
    find_normals();
    find_planes();
    const BoundaryLabels& labels = state_.mesh.labels;
    for (const LabeledEdge& edge : labels.edges)
      for (std::size_t k = 0; k < 2; ++k) verts_[edge.verts[k]].along.push_back(edge.verts[1 - k]);
    for (VertId v : state_.kind.ids())
      if (state_.is_boundary(v)) hold(v, verts_[v]);
    for (VertId v : labels.corners) fix(v);
    if (!state_.mesh.region.empty())
      for (const LabeledQuad& quad : labels.quads)
        for (VertId v : quad.verts) fix(v);
    return std::move(slides_);
  }

 private:
  void find_normals() {
    for (const auto& quad : state_.quads) {
      const Vec3 n = quad_normal(state_.mesh.positions, quad);
      for (VertId v : quad) {
        BoundaryVert& vert = verts_[v];
        if (vert.normal == Vec3{}) vert.normal = n;
        vert.is_flat &= norm(cross(vert.normal, n)) < kFlat && dot(vert.normal, n) > 0;
      }
    }
  }

  /// Of the box around, whose edges have no labels either.
  void find_planes() {
    std::vector<std::array<VertId, 4>> labelled;
    for (const LabeledQuad& quad : state_.mesh.labels.quads) labelled.push_back(sorted(quad.verts));
    std::sort(labelled.begin(), labelled.end());
    for (const auto& quad : state_.quads) {
      if (std::binary_search(labelled.begin(), labelled.end(), sorted(quad))) {
        for (VertId v : quad) verts_[v].is_labelled = true;
        continue;
      }
      const Vec3 n = quad_normal(state_.mesh.positions, quad);
      for (VertId v : quad) {
        auto& planes = verts_[v].planes;
        if (std::none_of(planes.begin(), planes.end(),
                         [&](const Vec3& other) { return dot(n, other) > kOnePlane; }))
          planes.push_back(n);
      }
    }
  }

  void fix(VertId v) {
    state_.kind[v] = VertKind::Interior;
    state_.move[v] = MoveIn::Point;
    slides_[v] = 0;
  }
  void move_along(VertId v, MoveIn move, const Vec3& axis) {
    state_.kind[v] = VertKind::Interior;
    state_.move[v] = move;
    state_.axis[v] = axis;
  }

  void hold(VertId v, const BoundaryVert& vert) {
    if (!vert.along.empty()) {
      hold_on_edge(v, vert.along);
    } else if (vert.planes.size() == 2 && !vert.is_labelled) {
      move_along(v, MoveIn::Line, normalized(cross(vert.planes[0], vert.planes[1])));
    } else if (!vert.planes.empty() && !vert.is_flat) {
      fix(v);  // a side of the domain meets a patch: it would be drawn off one of them
    } else if (vert.is_flat) {
      move_along(v, MoveIn::Plane, vert.normal);
    } else {
      slides_[v] = 1;
    }
  }

  void hold_on_edge(VertId v, const std::vector<VertId>& along) {
    const auto direction = [&](VertId to) {
      return normalized(state_.mesh.positions[to] - state_.mesh.positions[v]);
    };
    const Vec3 axis = direction(along[0]);
    const bool is_straight = along.size() == 2 && norm(cross(axis, direction(along[1]))) < kFlat;
    if (is_straight)
      move_along(v, MoveIn::Line, axis);
    else
      fix(v);
  }

  FitState& state_;
  IdVector<VertId, char> slides_;
  IdVector<VertId, BoundaryVert> verts_;
};

}  // namespace

IdVector<VertId, char> hold_boundary(FitState& state) { return Holder(state).run(); }

}  // namespace hexwright::layers
