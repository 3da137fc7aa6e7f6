// Wishes, and what limits them.
#include "layers/heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hexwright/base/parallel.h"

namespace hexwright::layers {
namespace {

constexpr double kGapShare = 0.4;  // of the way to a facing wall: what remains is for the inside
constexpr double kEndShare = 0.7;  // ... to the end of the mesh, where no layers come to meet
constexpr double kSizeFactor = 3;  // of the edges here
constexpr double kSlope = 0.4;     // of the sheet's other side against the wall
constexpr double kTilt = 0.45;     // tangent of the rays beside the normal
constexpr double kFacing = 0.5;    // least cosine between a normal and the facing wall's
constexpr int kNumSmoothings = 4;

double wish_of(const LayerSpec& spec, const SheetVert& vert, const Target& target) {
  switch (spec.first.unit) {
    case LayerLength::Unit::World:
    case LayerLength::Unit::Metre:  // add_layers() has none
      return target.frame.length_to_unit(spec.total());
    case LayerLength::Unit::Diagonal:
      return spec.total() * target.diagonal();
    case LayerLength::Unit::Edge:
      break;
  }
  return spec.total() * vert.size;
}

/// Casts rays into the mesh from a vertex of a wall.
class GapFinder {
 public:
  GapFinder(const Target& target, const Box3& box, const Vec3& from, const SheetVert& vert)
      : target_(target), box_(box), from_(from), size_(vert.size) {
    const auto nearest = target.tree.closest(from);
    if (!nearest) return;
    // On a crease the nearest triangle stands across one of the normals, and tells by the other.
    for (const Vec3& n : vert.normals) {
      const double cosine = dot(target.tree.normal(nearest->tri), n);
      if (std::abs(cosine) > std::abs(side_)) side_ = cosine;
    }
  }

  /// Along one of the wall's normals: the least over the ray and four beside it.
  double facing_wall(const Vec3& n) const {
    const Vec3 x =
        normalized(std::abs(n.x) < 0.6 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
    const Vec3 y = cross(n, x);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& tilt : {Vec3{}, x, -x, y, -y}) {
      const Vec3 d = normalized(n + tilt * kTilt);
      least = std::min(least, hit(d, n) * dot(d, n));
    }
    return least;
  }

  /// To the faces of the mesh's box.
  double end_of_mesh(const Vec3& n) const {
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(n[axis]) < kFacing) continue;
      const double way = ((n[axis] > 0 ? box_.hi : box_.lo)[axis] - from_[axis]) / n[axis];
      least = std::min(least, std::max(0.0, way));
    }
    return least;
  }

 private:
  /// Walls that stand beside this one are no facing walls: there two sheets meet in an edge.
  double hit(const Vec3& d, const Vec3& n) const {
    const auto counts = [&](const RayHit& hit) {
      const double there = dot(target_.tree.normal(hit.tri), n);
      return hit.length > 0.02 * size_ && there * (side_ > 0 ? 1 : -1) < -kFacing;
    };
    const auto found = target_.tree.first_hit(from_, d, counts);
    return found ? found->length : std::numeric_limits<double>::infinity();
  }

  const Target& target_;
  const Box3& box_;
  Vec3 from_;
  double size_;
  double side_ = 0;  // positive where the surface's normals point into the mesh
};

void lower(SheetVert& vert, double limit, LayerLimit reason) {
  if (!(limit < vert.height)) return;
  vert.height = limit;
  vert.limit = reason;
}

/// Edges as long as those around, so that relative wishes do not jump.
std::vector<double> smooth_sizes(const SheetMesh& sheet,
                                 const std::vector<std::vector<std::size_t>>& neighbors) {
  std::vector<double> sizes, next;
  for (const SheetVert& vert : sheet.verts) sizes.push_back(vert.size);
  for (int step = 0; step < 3; ++step) {
    next = sizes;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      double sum = sizes[i];
      for (std::size_t j : neighbors[i]) sum += sizes[j];
      next[i] = sum / (1.0 + static_cast<double>(neighbors[i].size()));
    }
    sizes.swap(next);
  }
  return sizes;
}

}  // namespace

std::vector<std::vector<std::size_t>> find_sheet_neighbors(const SheetMesh& sheet) {
  IdVector<VertId, std::size_t> index(sheet.mesh.num_verts(), 0);
  for (std::size_t i = 0; i < sheet.verts.size(); ++i) index[sheet.verts[i].inner] = i;
  std::vector<std::vector<std::size_t>> neighbors(sheet.verts.size());
  for (const SheetHex& hex : sheet.hexes) {
    const auto& v = sheet.mesh.hexes[hex.hex];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = index[v[k]], b = index[v[(k + 1) % 4]];
      neighbors[a].push_back(b);
      neighbors[b].push_back(a);
    }
  }
  for (auto& list : neighbors) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbors;
}

void smooth_from_below(SheetMesh& sheet, const std::vector<std::vector<std::size_t>>& neighbors) {
  const auto& p = sheet.mesh.positions;
  const auto lower_by = [&](SheetVert& vert, const SheetVert& other, double height) {
    lower(vert, height, other.limit == LayerLimit::None ? LayerLimit::Size : other.limit);
  };
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < sheet.verts.size(); ++i) {
      SheetVert& vert = sheet.verts[i];
      const double before = vert.height;
      for (std::size_t j : neighbors[i]) {
        const SheetVert& other = sheet.verts[j];
        lower_by(vert, other, other.height + kSlope * distance(p[vert.wall], p[other.wall]));
      }
      is_changed |= vert.height < before * (1 - 1e-9);
    }
  }
}

/// Only where something limits: wishes that follow the edges have their own differences.
static void smooth_limited(SheetMesh& sheet,
                           const std::vector<std::vector<std::size_t>>& neighbors) {
  for (int step = 0; step < kNumSmoothings; ++step) {
    const std::vector<SheetVert> before = sheet.verts;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (neighbors[i].empty()) continue;
      double sum = 0;
      const SheetVert* lowest = &before[i];
      for (std::size_t j : neighbors[i]) {
        sum += before[j].height;
        if (before[j].limit != LayerLimit::None &&
            (lowest->limit == LayerLimit::None || before[j].height < lowest->height))
          lowest = &before[j];
      }
      if (lowest->limit == LayerLimit::None) continue;
      const double mean = sum / static_cast<double>(neighbors[i].size());
      lower(sheet.verts[i], 0.5 * (before[i].height + mean), lowest->limit);
    }
  }
}

void set_heights(SheetMesh& sheet, const Target& target, const LayersOptions& options) {
  const auto neighbors = find_sheet_neighbors(sheet);
  const std::vector<double> sizes = smooth_sizes(sheet, neighbors);
  for (std::size_t i = 0; i < sizes.size(); ++i) sheet.verts[i].size = sizes[i];
  const Box3 box = bounding_box(sheet.mesh);
  parallel_for(
      sheet.verts.size(),
      [&](std::size_t i) {
        SheetVert& vert = sheet.verts[i];
        const LayerSpec& spec = options.specs[static_cast<std::size_t>(vert.spec)];
        vert.wish = vert.height = wish_of(spec, vert, target);
        lower(vert, kSizeFactor * vert.size, LayerLimit::Size);
        const GapFinder gaps(target, box, sheet.mesh.positions[vert.wall], vert);
        for (const Vec3& n : vert.normals) {
          lower(vert, kGapShare * gaps.facing_wall(n), LayerLimit::Gap);
          lower(vert, kEndShare * gaps.end_of_mesh(n), LayerLimit::Gap);
        }
      },
      64);
  smooth_from_below(sheet, neighbors);
  smooth_limited(sheet, neighbors);
}

}  // namespace hexwright::layers
