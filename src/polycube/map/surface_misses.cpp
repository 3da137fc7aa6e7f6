// The a-priori estimate of the distance that a mesh of these cells would leave: its boundary quads
// are of the size of the cells' faces, and their corners lie on the surface.
#include "polycube/map/surface_misses.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

namespace hexwright::polycube {
namespace {

constexpr int kSamplesPerEdge = 5;  // odd, so that the face's centre is among them

struct BoundaryFace {
  CellId cell;
  int direction;
};

// A face lies on the domain's boundary when the root cube beyond it is none of the domain's. Faces
// between leaves of different levels are inside, and no boundary.
std::vector<BoundaryFace> find_boundary_faces(const Grid& grid) {
  auto roots = grid.roots;
  std::sort(roots.begin(), roots.end());
  std::vector<BoundaryFace> faces;
  for (CellId c : grid.cells.ids())
    for (int direction = 0; direction < 6; ++direction) {
      const int axis = direction / 2;
      LatticeCoord beyond = grid.cells[c].corner;
      beyond[axis] += direction % 2 ? grid.cell_size(c) : -1;
      for (auto& x : beyond) x >>= grid.finest_level;
      if (!std::binary_search(roots.begin(), roots.end(), beyond)) faces.push_back({c, direction});
    }
  return faces;
}

// The surface between the mapped corners of the boundary faces, and samples of what the map really
// makes of them.
class CarriedBoundary {
 public:
  CarriedBoundary(const Grid& grid, const TetMesh& object, const BoundaryMap& boundary)
      : grid_(grid), object_(object), boundary_(boundary), faces_(find_boundary_faces(grid)) {
    samples_.resize(faces_.size() * kPerFace);
    parallel_for(
        samples_.size(), [&](std::size_t i) { samples_[i] = carry(i / kPerFace, i % kPerFace); },
        64);
  }

  std::size_t num_samples() const { return samples_.size(); }
  CellId cell(std::size_t sample) const { return faces_[sample / kPerFace].cell; }
  const Vec3& sample(std::size_t i) const { return samples_[i]; }

  // Each face as four triangles about the mean of its corners.
  TriMesh triangles() const {
    constexpr std::size_t kLast = kSamplesPerEdge - 1;
    constexpr std::size_t kCorners[4] = {0, kLast, kPerFace - 1, kPerFace - 1 - kLast};
    TriMesh mesh;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const VertId first(mesh.positions.size());
      Vec3 center;
      for (std::size_t corner : kCorners) {
        mesh.positions.push_back(samples_[f * kPerFace + corner]);
        center += mesh.positions[VertId(mesh.positions.size() - 1)] * 0.25;
      }
      const VertId middle = mesh.positions.push_back(center);
      for (int k = 0; k < 4; ++k)
        mesh.tris.push_back(
            {VertId(first.value() + k), VertId(first.value() + (k + 1) % 4), middle});
    }
    return mesh;
  }

 private:
  static constexpr std::size_t kPerFace = kSamplesPerEdge * kSamplesPerEdge;

  Vec3 carry(std::size_t f, std::size_t k) const {
    const auto [cell, direction] = faces_[f];
    const Box3 box = cell_box(grid_, cell);
    const int axis = direction / 2;
    const std::size_t column = k % kSamplesPerEdge, row = k / kSamplesPerEdge;
    const double s = static_cast<double>(column) / (kSamplesPerEdge - 1);
    const double t = static_cast<double>(row) / (kSamplesPerEdge - 1);
    Vec3 p;
    p[axis] = direction % 2 ? box.hi[axis] : box.lo[axis];
    p[(axis + 1) % 3] = box.lo[(axis + 1) % 3] + s * box.extent()[(axis + 1) % 3];
    p[(axis + 2) % 3] = box.lo[(axis + 2) % 3] + t * box.extent()[(axis + 2) % 3];
    return boundary_.carry(object_, boundary_.closest(p, direction));
  }

  const Grid& grid_;
  const TetMesh& object_;
  const BoundaryMap& boundary_;
  std::vector<BoundaryFace> faces_;
  std::vector<Vec3> samples_;  // kPerFace per face, row by row
};

}  // namespace

std::vector<char> mark_surface_misses(const Grid& grid, const TetMesh& object,
                                      const Lattice& lattice, const BoundaryMap& boundary,
                                      const IdVector<VertId, Vec3>& inward, double limit) {
  const CarriedBoundary carried(grid, object, boundary);
  const SurfaceTree tree(carried.triangles());
  // Only whether something is within reach matters, so the search stops there.
  const auto is_missed = [&](const Vec3& p) {
    ClosestFilter near;
    near.max_distance = limit;
    return !tree.closest(p, near);
  };
  std::vector<char> is_far(carried.num_samples(), 0);
  parallel_for(
      is_far.size(), [&](std::size_t i) { is_far[i] = is_missed(carried.sample(i)); }, 64);

  std::vector<char> marks(grid.num_cells(), 0);
  for (std::size_t i = 0; i < is_far.size(); ++i)
    if (is_far[i]) marks[carried.cell(i).index()] = 1;
  // The samples may all miss what is smaller than their spacing; the object's vertices do not.
  std::vector<char> is_on_boundary(object.num_verts(), 0);
  for (const auto& facet : lattice.facets)
    for (VertId v : facet) is_on_boundary[v.index()] = 1;
  for (VertId v : object.positions.ids()) {
    if (!is_on_boundary[v.index()] || !is_missed(object.positions[v])) continue;
    const CellId c = find_leaf_at(grid, inward[v]);
    if (c.is_valid()) marks[c.index()] = 1;
  }
  return marks;
}

}  // namespace hexwright::polycube
