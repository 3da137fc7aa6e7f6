// Sheet insertion with offsets that shrink where a hex would be inverted.
#include "fit/sheets/insert.h"

#include <algorithm>
#include <limits>

#include "hexwright/mesh/hex_shape.h"

namespace hexwright::fitting {
namespace {

constexpr double kDepth = 0.3;  // first offset, in shortest incident edges
constexpr double kShrink = 0.6;
constexpr int kMaxShrinks = 60;
// Scaled. Far below what any pass works towards: what is left out by it is degenerate already.
constexpr double kMinJacobian = 1e-7;

class Inserter {
 public:
  Inserter(HexMesh& mesh, const VertToHex& vert_to_hex, const SheetPlan& plan)
      : mesh_(mesh), vert_to_hex_(vert_to_hex), sheet_(plan.sheet), plan_(plan) {}

  Insertion run() {
    measure_offsets();
    split();
    place_all();
    std::vector<VertId> stuck = shrink();
    if (stuck.empty()) return {std::move(copies_), {}};
    undo();
    return {{}, std::move(stuck)};
  }

 private:
  void measure_offsets() {
    for (VertId v : sheet_.verts) {
      double shortest = std::numeric_limits<double>::infinity();
      for (const HexCorner& corner : vert_to_hex_[v])
        for (int lv : kHexCornerNeighbors[static_cast<std::size_t>(corner.lv)]) {
          const VertId w = mesh_.hexes[corner.hex][static_cast<std::size_t>(lv)];
          shortest = std::min(shortest, distance(mesh_.positions[w], mesh_.positions[v]));
        }
      offsets_.push_back(kDepth * shortest);
    }
  }

  /// Gives the hexes behind the sheet their copies and adds the sheet's hexes.
  void split() {
    num_old_verts_ = mesh_.num_verts();
    num_old_hexes_ = mesh_.num_hexes();
    touched_.resize(sheet_.verts.size());
    for (std::size_t i = 0; i < sheet_.verts.size(); ++i) {
      const VertId v = sheet_.verts[i];
      copies_.push_back(mesh_.positions.push_back(mesh_.positions[v]));
      for (const HexCorner& corner : vert_to_hex_[v]) {
        if (!plan_.takes_copy.empty() && plan_.takes_copy[corner.hex.index()] == 0) continue;
        mesh_.hexes[corner.hex][static_cast<std::size_t>(corner.lv)] = copies_[i];
        replaced_.push_back({corner, v});
        touched_[i].push_back(corner.hex);
      }
    }
    for (std::size_t q = 0; q < sheet_.quads.size(); ++q) {
      const auto& quad = sheet_.quads[q];
      std::array<VertId, 8> hex;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t i = sheet_.index_of(quad[k]);
        hex[k] = copies_[i];
        hex[k + 4] = quad[k];
        touched_[i].push_back(HexId(mesh_.num_hexes()));
      }
      mesh_.hexes.push_back(hex);
      if (!mesh_.region.empty()) mesh_.region.push_back(mesh_.region[sheet_.behind[q]]);
    }
  }

  void place(std::size_t i) {
    mesh_.positions[copies_[i]] =
        mesh_.positions[sheet_.verts[i]] - plan_.directions[i] * offsets_[i];
  }
  void place_all() {
    for (std::size_t i = 0; i < copies_.size(); ++i) place(i);
  }

  bool is_good(HexId h) const { return scaled_jacobian(mesh_.corners(h)) > kMinJacobian; }

  /// Shrinks the offsets around hexes that are not good. Returns the sheet's vertices at hexes that
  /// are not good in the end.
  std::vector<VertId> shrink() {
    std::vector<HexId> to_check;
    for (const auto& hexes : touched_) to_check.insert(to_check.end(), hexes.begin(), hexes.end());
    std::vector<std::size_t> shrinking;
    for (int it = 0; it <= kMaxShrinks; ++it) {
      std::sort(to_check.begin(), to_check.end());
      to_check.erase(std::unique(to_check.begin(), to_check.end()), to_check.end());
      shrinking.clear();
      for (HexId h : to_check)
        if (!is_good(h))
          for (VertId v : mesh_.hexes[h])
            if (v.index() >= num_old_verts_) shrinking.push_back(v.index() - num_old_verts_);
      if (shrinking.empty()) break;
      std::sort(shrinking.begin(), shrinking.end());
      shrinking.erase(std::unique(shrinking.begin(), shrinking.end()), shrinking.end());
      to_check.clear();
      for (std::size_t i : shrinking) {
        offsets_[i] *= kShrink;
        place(i);
        to_check.insert(to_check.end(), touched_[i].begin(), touched_[i].end());
      }
    }
    std::vector<VertId> stuck;
    for (std::size_t i : shrinking) stuck.push_back(sheet_.verts[i]);
    return stuck;
  }

  void undo() {
    for (const auto& [corner, v] : replaced_)
      mesh_.hexes[corner.hex][static_cast<std::size_t>(corner.lv)] = v;
    mesh_.hexes.resize(num_old_hexes_);
    if (!mesh_.region.empty()) mesh_.region.resize(num_old_hexes_);
    mesh_.positions.resize(num_old_verts_);
  }

  struct Replaced {
    HexCorner corner;
    VertId old;
  };

  HexMesh& mesh_;
  const VertToHex& vert_to_hex_;
  const Sheet& sheet_;
  const SheetPlan& plan_;
  std::vector<double> offsets_;              // per sheet vertex
  std::vector<VertId> copies_;               // per sheet vertex
  std::vector<std::vector<HexId>> touched_;  // per sheet vertex: hexes that use its copy
  std::vector<Replaced> replaced_;
  std::size_t num_old_verts_ = 0, num_old_hexes_ = 0;
};

}  // namespace

Insertion insert_sheet(HexMesh& mesh, const VertToHex& vert_to_hex, const SheetPlan& plan) {
  return Inserter(mesh, vert_to_hex, plan).run();
}

}  // namespace hexwright::fitting
