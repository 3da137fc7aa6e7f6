// Vertices between a wall and the sheet's other side, one stack per sheet vertex.
#include "layers/split.h"

#include <algorithm>

namespace hexwright::layers {
namespace {

class Splitter {
 public:
  Splitter(const SheetMesh& sheet, const LayersOptions& options)
      : sheet_(sheet),
        options_(options),
        stack_of_(sheet.mesh.num_verts(), kNone),
        spec_of_hex_(sheet.mesh.num_hexes(), kNoSpec) {
    for (const SheetHex& hex : sheet.hexes) spec_of_hex_[hex.hex] = hex.spec;
  }

  SplitMesh run() {
    result_.mesh.positions = sheet_.mesh.positions;
    result_.mesh.region_names = sheet_.mesh.region_names;
    result_.mesh.labels = sheet_.mesh.labels;
    make_stacks();
    copy_others();
    for (const SheetHex& hex : sheet_.hexes) split_hex(hex);
    split_rim_quads();
    split_edges();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// From the wall to the inner vertex.
  void make_stacks() {
    for (std::size_t i = 0; i < sheet_.verts.size(); ++i) {
      const SheetVert& vert = sheet_.verts[i];
      const LayerSpec& spec = options_.specs[static_cast<std::size_t>(vert.spec)];
      const Vec3 from = sheet_.mesh.positions[vert.wall];
      const Vec3 way = sheet_.mesh.positions[vert.inner] - from;
      std::vector<VertId> stack = {vert.wall};
      for (int k = 1; k < spec.count; ++k)
        stack.push_back(result_.mesh.positions.push_back(from + way * spec.share_of(k)));
      stack.push_back(vert.inner);
      stack_of_[vert.inner] = stacks_.size();
      stacks_.push_back(std::move(stack));
    }
  }
  /// By the inner vertex, which is in one sheet only.
  const std::vector<VertId>& stack(VertId inner) const { return stacks_[stack_of_[inner]]; }
  bool is_stack(VertId wall, VertId inner) const {
    return stack_of_[inner] != kNone && stack(inner).front() == wall;
  }

  void add_hex(const std::array<VertId, 8>& hex, HexId from, std::int32_t layer) {
    result_.mesh.hexes.push_back(hex);
    if (!sheet_.mesh.region.empty()) result_.mesh.region.push_back(sheet_.mesh.region[from]);
    result_.layer.push_back(layer);
  }

  void copy_others() {
    for (HexId h : sheet_.mesh.hexes.ids())
      if (spec_of_hex_[h] == kNoSpec) add_hex(sheet_.mesh.hexes[h], h, 0);
  }

  void split_hex(const SheetHex& hex) {
    const auto& verts = sheet_.mesh.hexes[hex.hex];
    const int count = options_.specs[static_cast<std::size_t>(hex.spec)].count;
    for (int layer = 1; layer <= count; ++layer) {
      std::array<VertId, 8> part;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& s = stack(verts[k]);
        part[k] = s[static_cast<std::size_t>(layer)];
        part[k + 4] = s[static_cast<std::size_t>(layer) - 1];
      }
      add_hex(part, hex.hex, layer);
    }
  }

  /// Those of the form {wall, wall, inner, inner}, as they were inserted.
  void split_rim_quads() {
    auto& quads = result_.mesh.labels.quads;
    std::vector<LabeledQuad> kept;
    for (const LabeledQuad& quad : quads) {
      const auto& v = quad.verts;
      if (!is_stack(v[1], v[2]) || !is_stack(v[0], v[3])) {
        kept.push_back(quad);
        continue;
      }
      const auto &a = stack(v[3]), &b = stack(v[2]);
      for (std::size_t k = 0; k + 1 < a.size(); ++k)
        kept.push_back({{a[k], b[k], b[k + 1], a[k + 1]}, quad.patch});
    }
    quads = std::move(kept);
  }

  void split_edges() {
    auto& edges = result_.mesh.labels.edges;
    std::vector<LabeledEdge> kept;
    for (const LabeledEdge& edge : edges) {
      const auto [a, b] = edge.verts;
      if (!is_stack(a, b)) {
        kept.push_back(edge);
        continue;
      }
      const auto& s = stack(b);
      for (std::size_t k = 0; k + 1 < s.size(); ++k) kept.push_back({{s[k], s[k + 1]}, edge.curve});
    }
    edges = std::move(kept);
  }

  const SheetMesh& sheet_;
  const LayersOptions& options_;
  SplitMesh result_;
  std::vector<std::vector<VertId>> stacks_;
  IdVector<VertId, std::size_t> stack_of_;  // of inner vertices
  IdVector<HexId, int> spec_of_hex_;
};

}  // namespace

SplitMesh split_sheet(const SheetMesh& sheet, const LayersOptions& options) {
  return Splitter(sheet, options).run();
}

}  // namespace hexwright::layers
