#include "render/page/view_arrays.h"

#include <algorithm>
#include <cmath>

#include "render/page/packing.h"

namespace hexwright {
namespace {

using Numbers = std::vector<std::uint32_t>;

constexpr std::uint32_t kNotShown = 0xffffffffU;  // new id of a vertex outside of the sample
constexpr double kSteps = 65535;                  // of a position along each axis

std::string pack(const Numbers& numbers, int num_bytes) {
  return to_packed_text(to_planes(numbers, num_bytes));
}

std::string pack_deltas(const Numbers& numbers) { return pack(to_deltas(numbers, 4), 4); }

// A box without extent along an axis has all positions at its lower end there; vertices that no
// triangle uses may lie outside of it.
template <class Positions>
std::string pack_positions(const Positions& positions, const Box3& box) {
  std::string planes;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = box.extent()[axis];
    Numbers numbers;
    numbers.reserve(positions.size());
    for (const Vec3& p : positions) {
      const double share = extent > 0 ? (p[axis] - box.lo[axis]) / extent : 0;
      numbers.push_back(
          static_cast<std::uint32_t>(std::lround(kSteps * std::clamp(share, 0.0, 1.0))));
    }
    planes += to_planes(to_deltas(numbers, 2), 2);
  }
  return to_packed_text(planes);
}

// Values of [low, high] as 0 .. 255; what is not finite as 0.
std::uint8_t to_byte(double value, double low, double high) {
  if (!std::isfinite(value) || !(high > low)) return 0;
  return static_cast<std::uint8_t>(std::lround(255 * (value - low) / (high - low)));
}

// Packs the arrays of one mesh in the order of the sample's hexes.
class Packer {
 public:
  Packer(const HexMesh& mesh, const ViewScene& scene, const ViewOptions& options)
      : mesh_(mesh), scene_(scene), options_(options), verts_(sampled_verts(mesh, scene.sample)) {
    new_id_.resize(mesh.num_verts(), kNotShown);
    for (std::size_t i = 0; i < verts_.size(); ++i)
      new_id_[verts_[i]] = static_cast<std::uint32_t>(i);
  }

  ViewArrays run(const std::vector<std::int32_t>& regions) {
    add_mesh();
    add("quality", per_hex([&](HexId h) { return quality_code(scene_.scaled_jacobian[h]); }), 1);
    add("depth", per_hex([&](HexId h) { return scene_.depth[h]; }), 1);
    add_marked_faces();
    if (regions.size() > 1) add_regions(regions);
    for (std::size_t i = 0; i < options_.fields.size(); ++i) add_field(i);
    if (mesh_.mid_nodes) add_mid_nodes();
    add_curves();
    if (options_.surface) add_surface();
    return std::move(arrays_);
  }

 private:
  void add(const char* name, const Numbers& numbers, int num_bytes) {
    arrays_.emplace_back(name, pack(numbers, num_bytes));
  }

  template <class Value>
  Numbers per_hex(Value&& value) const {
    Numbers numbers;
    numbers.reserve(scene_.sample.hexes.size());
    for (HexId h : scene_.sample.hexes) numbers.push_back(static_cast<std::uint32_t>(value(h)));
    return numbers;
  }

  void add_mesh() {
    std::vector<Vec3> positions;
    positions.reserve(verts_.size());
    for (VertId v : verts_) positions.push_back(mesh_.positions[v]);
    arrays_.emplace_back("positions", pack_positions(positions, view_box(mesh_, options_)));
    Numbers hexes;
    hexes.reserve(8 * scene_.sample.hexes.size());
    std::uint32_t first = 0;
    for (HexId h : scene_.sample.hexes) {
      std::uint32_t last = first;
      first = new_id_[mesh_.hexes[h][0]];
      for (VertId v : mesh_.hexes[h]) {
        hexes.push_back(to_zigzag(new_id_[v] - last, 4));
        last = new_id_[v];
      }
    }
    add("hexes", hexes, 4);
    if (!scene_.sample.is_whole)
      arrays_.emplace_back("hex_ids", pack_deltas(per_hex([](HexId h) { return h.value(); })));
    if (verts_.size() == mesh_.num_verts()) return;
    Numbers ids;
    for (VertId v : verts_) ids.push_back(static_cast<std::uint32_t>(v.value()));
    arrays_.emplace_back("vert_ids", pack_deltas(ids));
  }

  /// Numbered as the sample's hexes name them.
  void add_mid_nodes() {
    const MidNodes& nodes = *mesh_.mid_nodes;
    IdVector<EdgeId, std::uint32_t> number(nodes.edges.size(), 0);
    std::vector<Vec3> positions;
    Numbers numbers;
    numbers.reserve(12 * scene_.sample.hexes.size());
    for (HexId h : scene_.sample.hexes)
      for (std::size_t le = 0; le < 12; ++le) {
        const EdgeId e = nodes.hex_to_edge[h][le];
        if (number[e] == 0 && is_bent(h, le)) {
          positions.push_back(nodes.edges[e]);
          number[e] = static_cast<std::uint32_t>(positions.size());
        }
        numbers.push_back(number[e]);
      }
    if (positions.empty()) return;
    arrays_.emplace_back("mid_positions", pack_positions(positions, view_box(mesh_, options_)));
    arrays_.emplace_back("hex_mids", pack_deltas(numbers));
  }

  bool is_bent(HexId h, std::size_t le) const {
    const auto corner = [&](std::size_t end) {
      return mesh_.positions[mesh_.hexes[h][static_cast<std::size_t>(kHexEdges[le][end])]];
    };
    const Vec3 a = corner(0), b = corner(1);
    const Vec3& node = mesh_.mid_nodes->edges[mesh_.mid_nodes->hex_to_edge[h][le]];
    return norm_sq(node - 0.5 * (a + b)) > 1e-12 * norm_sq(b - a);
  }

  // The scene's lists run over the marked faces of all hexes, the page's over those of the sample.
  void add_marked_faces() {
    const double largest = scene_.distance.empty() ? 0.0 : largest_distance(scene_);
    Numbers patches, distances;
    std::size_t at = 0, next = 0;
    bool has_patches = false;
    for (HexId h : scene_.marked.ids()) {
      const bool is_shown = next < scene_.sample.hexes.size() && scene_.sample.hexes[next] == h;
      for (int lf = 0; lf < 6; ++lf) {
        if ((scene_.marked[h] >> lf & 1) == 0) continue;
        if (is_shown) {
          const PatchId patch = scene_.patch[at];
          has_patches = has_patches || patch.is_valid();
          patches.push_back(patch.is_valid() ? static_cast<std::uint32_t>(patch.value()) + 1 : 0);
          if (!scene_.distance.empty())
            distances.push_back(to_byte(static_cast<double>(scene_.distance[at]), 0, largest));
        }
        ++at;
      }
      next += is_shown ? 1 : 0;
    }
    add("faces", per_hex([&](HexId h) { return scene_.marked[h]; }), 1);
    if (has_patches) add("patches", patches, 4);
    if (!scene_.distance.empty()) add("distance", distances, 1);
  }

  void add_regions(const std::vector<std::int32_t>& regions) {
    const auto index_of = [&](HexId h) {
      return std::lower_bound(regions.begin(), regions.end(), mesh_.region[h]) - regions.begin();
    };
    add("regions", per_hex(index_of), 4);
  }

  void add_field(std::size_t i) {
    const HexField& field = options_.fields[i];
    const auto [low, high] = field_range(field);
    const auto byte = [&, low = low, high = high](HexId h) {
      return to_byte(field.values[h.index()], low, high);
    };
    arrays_.emplace_back("field_" + std::to_string(i), pack(per_hex(byte), 1));
  }

  void add_curves() {
    Numbers verts, curves, corners;
    for (const LabeledEdge& edge : mesh_.labels.edges) {
      if (new_id_[edge.verts[0]] == kNotShown || new_id_[edge.verts[1]] == kNotShown) continue;
      for (VertId v : edge.verts) verts.push_back(new_id_[v]);
      curves.push_back(static_cast<std::uint32_t>(edge.curve.value() + 1));
    }
    for (VertId v : mesh_.labels.corners)
      if (new_id_[v] != kNotShown) corners.push_back(new_id_[v]);
    if (!verts.empty()) arrays_.emplace_back("curves", pack_deltas(verts));
    if (!verts.empty()) arrays_.emplace_back("curve_ids", pack_deltas(curves));
    if (!corners.empty()) arrays_.emplace_back("corners", pack_deltas(corners));
  }

  void add_surface() {
    const TriMesh& surface = options_.surface->surface();
    arrays_.emplace_back("surface_positions",
                         pack_positions(surface.positions.raw(), view_box(mesh_, options_)));
    Numbers tris;
    for (const auto& tri : surface.tris)
      for (VertId v : tri) tris.push_back(static_cast<std::uint32_t>(v.value()));
    arrays_.emplace_back("surface_tris", pack_deltas(tris));
  }

  const HexMesh& mesh_;
  const ViewScene& scene_;
  const ViewOptions& options_;
  std::vector<VertId> verts_;
  IdVector<VertId, std::uint32_t> new_id_;
  ViewArrays arrays_;
};

}  // namespace

ViewArrays make_view_arrays(const HexMesh& mesh, const ViewScene& scene, const ViewOptions& options,
                            const std::vector<std::int32_t>& regions) {
  return Packer(mesh, scene, options).run(regions);
}

std::uint8_t quality_code(double scaled_jacobian) {
  if (!(scaled_jacobian > 0)) return 0;
  return static_cast<std::uint8_t>(std::clamp(std::floor(250 * scaled_jacobian) + 1, 1.0, 250.0));
}

std::pair<double, double> field_range(const HexField& field) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : field.values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low <= high ? std::pair(low, high) : std::pair(0.0, 0.0);
}

double largest_distance(const ViewScene& scene) {
  float largest = 0;
  for (const float value : scene.distance)
    if (std::isfinite(value)) largest = std::max(largest, value);
  return static_cast<double>(largest);
}

Box3 view_box(const HexMesh& mesh, const ViewOptions& options) {
  Box3 box = bounding_box(mesh);
  if (mesh.mid_nodes)
    for (const Vec3& p : mesh.mid_nodes->edges) box.extend(p);
  if (options.surface) box.extend(options.surface->box());
  return box;
}

std::vector<VertId> sampled_verts(const HexMesh& mesh, const ViewSample& sample) {
  IdVector<VertId, char> is_used(mesh.num_verts(), 0);
  for (HexId h : sample.hexes)
    for (VertId v : mesh.hexes[h]) is_used[v] = 1;
  std::vector<VertId> verts;
  for (VertId v : mesh.positions.ids())
    if (is_used[v]) verts.push_back(v);
  return verts;
}

}  // namespace hexwright
