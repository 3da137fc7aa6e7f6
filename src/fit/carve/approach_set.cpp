#include "fit/carve/approach_set.h"

#include <algorithm>
#include <cmath>

#include "fit/carve/set_topology.h"

namespace hexwright::fitting {
namespace {

class Approach {
 public:
  Approach(const SetScene& scene, double threshold, std::vector<char>& in_set)
      : scene_(scene),
        threshold_(threshold),
        in_set_(in_set),
        check_(scene.mesh, scene.vert_to_hex, scene.neighbors, true) {}

  std::size_t run() {
    std::vector<HexId> wrong = collect_wrong();
    std::size_t num_flips = take_off_layers(wrong);
    while (const std::size_t num_crumbs = take_off_crumbs(wrong))
      num_flips += num_crumbs + take_off_layers(wrong);
    return num_flips;
  }

 private:
  /// Walls and gaps one hex thick are not peeled from their rim. Flipped hexes leave the list.
  std::size_t take_off_layers(std::vector<HexId>& wrong) {
    constexpr int kMaxSweeps = 40;  // one takes off about one layer
    std::size_t num_flips = 0;
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      const auto rest = std::remove_if(wrong.begin(), wrong.end(),
                                       [&](HexId h) { return !is_thin(h) && flip(h); });
      if (rest == wrong.end()) break;
      num_flips += static_cast<std::size_t>(wrong.end() - rest);
      wrong.erase(rest, wrong.end());
    }
    return num_flips;
  }

  /// The last hexes of a layer, single or in rows, are as thin as a wall, but they lie on hexes
  /// that are as they should be. Only those that can go before any goes do, so that no wall is
  /// peeled.
  std::size_t take_off_crumbs(std::vector<HexId>& wrong) {
    std::vector<char> is_crumb(in_set_.size(), 0);
    for (HexId h : wrong)
      is_crumb[h.index()] =
          lies_on_right(h) && is_disc(faces_on_set(scene_.neighbors, in_set_, h)) ? 1 : 0;
    const auto rest = std::remove_if(wrong.begin(), wrong.end(),
                                     [&](HexId h) { return is_crumb[h.index()] && flip(h); });
    const auto num_flips = static_cast<std::size_t>(wrong.end() - rest);
    wrong.erase(rest, wrong.end());
    return num_flips;
  }

  /// Whether a neighbour of the hex's own kind is rightly so.
  bool lies_on_right(HexId h) const {
    const auto& around = scene_.neighbors.neighbor[h];
    return std::any_of(around.begin(), around.end(), [&](HexId other) {
      return other.is_valid() && in_set_[other.index()] == in_set_[h.index()] &&
             wrongness(other) <= 0;
    });
  }

  bool is_thin(HexId h) const {
    const unsigned on_set = faces_on_set(scene_.neighbors, in_set_, h);
    return is_one_thick(in_set_[h.index()] ? on_set : 63u & ~on_set);
  }

  double wrongness(HexId h) const {
    const double excess = scene_.filling.fraction[h] - threshold_;
    return in_set_[h.index()] ? -excess : excess;
  }

  std::vector<HexId> collect_wrong() const {
    std::vector<HexId> wrong;
    for (HexId h : scene_.mesh.hexes.ids())
      if (wrongness(h) > 0) wrong.push_back(h);
    std::stable_sort(wrong.begin(), wrong.end(),
                     [&](HexId a, HexId b) { return wrongness(a) > wrongness(b); });
    return wrong;
  }

  // Flips the hex if that only deforms the set. The faces on the hexes of its own kind are those
  // that carry it: in the set when it leaves, out of it when it enters.
  bool flip(HexId h) {
    const unsigned on_set = faces_on_set(scene_.neighbors, in_set_, h);
    char& in = in_set_[h.index()];
    if (!is_disc(on_set)) return false;
    in = !in;
    for (VertId v : scene_.mesh.hexes[h])
      if (check_.check(v, in_set_, scene_.visible) != SetFault::None) {
        in = !in;
        return false;
      }
    return true;
  }

  const SetScene& scene_;
  double threshold_;
  std::vector<char>& in_set_;
  SetCheck check_;
};

}  // namespace

std::size_t approach_threshold(const SetScene& scene, double threshold, std::vector<char>& in_set) {
  return Approach(scene, threshold, in_set).run();
}

}  // namespace hexwright::fitting
