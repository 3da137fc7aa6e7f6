// A queue of bad vertices; each is mended by the cheapest flip of one, two or three hexes at it.
// The cost counts bad vertices made and unmade and how wrong the flipped hexes become; a jitter
// that grows with the visits leads out of cycles, and in the end the vertex's surroundings are
// filled or emptied.
#include "fit/carve/carve_repair.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <span>

#include "hexwright/base/parallel.h"

namespace hexwright::fitting {
namespace {

constexpr int kPatience = 14;      // visits before the surroundings are filled or emptied
constexpr int kLastPatience = 18;  // visits before they are filled in any case

class Repair {
 public:
  Repair(const HexMesh& mesh, const VertToHex& vert_to_hex, const HexNeighbors& neighbors,
         const HexFilling& filling, double visible, std::vector<char>& in_set)
      : mesh_(mesh),
        vert_to_hex_(vert_to_hex),
        neighbors_(neighbors),
        filling_(filling),
        visible_(visible),
        in_set_(in_set),
        check_(mesh, vert_to_hex, neighbors, true),
        visits_(mesh.num_verts(), 0),
        is_queued_(mesh.num_verts(), 0) {}

  RepairResult run() {
    queue_bad_verts();
    const std::size_t limit = 50 * mesh_.num_verts();
    for (std::size_t step = 0; !queue_.empty() && step < limit; ++step) {
      const VertId v = queue_.front();
      queue_.pop_front();
      is_queued_[v] = 0;
      if (is_bad(v)) mend(v);
    }
    empty_around_bad_verts();
    return result_;
  }

 private:
  using Candidate = std::array<HexId, 3>;

  bool is_bad(VertId v) { return check_.check(v, in_set_, visible_) != SetFault::None; }

  void queue_bad_verts() {
    std::vector<char> bad(mesh_.num_verts());
    parallel_chunks(mesh_.num_verts(), 2048, [&](std::size_t begin, std::size_t end) {
      SetCheck check(mesh_, vert_to_hex_, neighbors_, true);
      for (std::size_t v = begin; v < end; ++v)
        bad[v] = check.check(VertId(v), in_set_, visible_) != SetFault::None;
    });
    for (VertId v : mesh_.positions.ids())
      if (bad[v.index()]) push(v);
  }

  // What the queue could not mend is cut away. Ends, for the set shrinks in every round.
  void empty_around_bad_verts() {
    for (bool any = true; any;) {
      any = false;
      for (VertId v : mesh_.positions.ids()) {
        if (!is_bad(v)) continue;
        any = true;
        ++result_.num_bad_verts;
        for (const HexCorner& corner : vert_to_hex_[v]) in_set_[corner.hex.index()] = 0;
      }
    }
  }

  void push(VertId v) {
    if (is_queued_[v]) return;
    is_queued_[v] = 1;
    queue_.push_back(v);
  }

  // How much worse the filling is represented when the hex changes sides, in units of the smallest
  // hex at the vertex.
  double misfit(HexId h, double least_edge) const {
    const bool in = in_set_[h.index()] != 0;
    const double wrong = in ? filling_.fraction[h] - 0.5 : 0.5 - filling_.fraction[h];
    return 1.8 * std::max(-0.2, wrong) * filling_.edge[h] / least_edge * (in ? 1.2 : 1.0);
  }

  void flip(std::span<const HexId> hexes) {
    for (HexId h : hexes) in_set_[h.index()] = !in_set_[h.index()];
  }

  int count_bad(std::span<const HexId> hexes) {
    touched_.clear();
    for (HexId h : hexes)
      touched_.insert(touched_.end(), mesh_.hexes[h].begin(), mesh_.hexes[h].end());
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    int count = 0;
    for (VertId u : touched_) count += is_bad(u);
    return count;
  }

  // Keeps the candidate with the least cost; a candidate that is too costly already by its misfit
  // is not tried.
  void consider(VertId v, std::span<const HexId> hexes) {
    const int visits = visits_[v];
    double cost = 0;
    for (HexId h : hexes) cost += misfit(h, least_edge_);
    if (visits > 4) {
      const auto first = static_cast<long>(hexes[0].value());
      const long noise = (first * 7 + visits * 13 + static_cast<long>(hexes.size()) * 5) % 8;
      cost += 0.25 * visits * static_cast<double>(noise) / 8;
    }
    const int before = count_bad(hexes);
    if (cost - before >= best_cost_) return;
    flip(hexes);
    cost += count_bad(hexes) - before;
    if (is_bad(v)) cost += 1;
    flip(hexes);
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_.assign(hexes.begin(), hexes.end());
    }
  }

  void consider_all(VertId v) {
    const auto corners = vert_to_hex_[v];
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) consider(v, Candidate{corners[i].hex}, 1);
    if (best_cost_ > -0.3 && n <= 16)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
          consider(v, Candidate{corners[i].hex, corners[j].hex}, 2);
    if (best_cost_ > 0.3 && visits_[v] > 2 && n <= 10)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (std::size_t k = 0; k < j; ++k)
            consider(v, Candidate{corners[i].hex, corners[j].hex, corners[k].hex}, 3);
  }
  void consider(VertId v, const Candidate& hexes, std::size_t count) {
    consider(v, std::span<const HexId>(hexes.data(), count));
  }

  void mend(VertId v) {
    ++visits_[v];
    least_edge_ = filling_.edge[vert_to_hex_[v][0].hex];
    for (const HexCorner& corner : vert_to_hex_[v])
      least_edge_ = std::min(least_edge_, filling_.edge[corner.hex]);
    best_cost_ = 1e9;
    best_.clear();
    consider_all(v);
    if (visits_[v] > kPatience) {
      fill_or_empty(v);
    } else {
      flip(best_);
      result_.num_flips += best_.size();
      for (HexId h : best_) queue_around(h);
    }
    if (is_bad(v)) push(v);
  }

  void fill_or_empty(VertId v) {
    double cost_of_filling = 0, cost_of_emptying = 0;
    for (const HexCorner& corner : vert_to_hex_[v]) {
      const double change =
          std::abs(filling_.fraction[corner.hex] - 0.5) * filling_.edge[corner.hex];
      (in_set_[corner.hex.index()] ? cost_of_emptying : cost_of_filling) += change;
    }
    const bool fill = cost_of_filling <= cost_of_emptying || visits_[v] > kLastPatience;
    for (const HexCorner& corner : vert_to_hex_[v]) {
      char& in = in_set_[corner.hex.index()];
      if ((in != 0) != fill) ++result_.num_flips;
      in = fill;
    }
    for (const HexCorner& corner : vert_to_hex_[v]) queue_around(corner.hex);
  }

  void queue_around(HexId h) {
    for (VertId u : mesh_.hexes[h])
      if (!is_queued_[u] && is_bad(u)) push(u);
  }

  const HexMesh& mesh_;
  const VertToHex& vert_to_hex_;
  const HexNeighbors& neighbors_;
  const HexFilling& filling_;
  double visible_;
  std::vector<char>& in_set_;
  SetCheck check_;
  IdVector<VertId, int> visits_;
  IdVector<VertId, char> is_queued_;
  std::deque<VertId> queue_;
  std::vector<VertId> touched_;
  std::vector<HexId> best_;
  double best_cost_ = 0, least_edge_ = 0;
  RepairResult result_;
};

}  // namespace

RepairResult repair_set(const HexMesh& mesh, const VertToHex& vert_to_hex,
                        const HexNeighbors& neighbors, const HexFilling& filling, double visible,
                        std::vector<char>& in_set) {
  return Repair(mesh, vert_to_hex, neighbors, filling, visible, in_set).run();
}

}  // namespace hexwright::fitting
