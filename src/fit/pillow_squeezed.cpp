// Pillows under squeezed quads, many at a time: sets that share no vertex go in together, so that
// the adjacency is rebuilt once per batch.
#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include "fit/feature_layers.h"
#include "fit/set_check.h"

namespace hexwright::fitting {
namespace {

constexpr double kDepth = 0.3;
constexpr int kMaxBatches = 60;

/// Squeezed quads of one region that are treated together.
struct Job {
  RegionId region;
  std::vector<QuadId> quads;  ///< squeezed ones, of the state the job was made in
};

/// Hexes to pillow and the sheet around them.
struct PillowSet {
  std::vector<HexId> hexes;  ///< ascending
  Sheet sheet;
};

/// Finds sets that can be pillowed in one state of the mesh.
class PillowPlanner {
 public:
  PillowPlanner(const FitState& state, const FeatureMarks& marks, const MarkedGraph& marked,
                const PillowOptions& options)
      : state_(state),
        marks_(marks),
        marked_(marked),
        options_(options),
        check_(state.mesh, state.vert_to_hex, state.neighbors, false),
        is_in_(state.mesh.num_hexes(), 0),
        is_selected_(state.quads.size(), 0),
        is_sheet_vert_(state.num_verts(), 0) {}

  /// The job's set with the first extent that works; empty hexes when none does.
  PillowSet plan(const Job& job) {
    if (options_.whole_regions) return try_quads(job, quads_of_region(job.region));
    for (int ring : {options_.ring, 0, options_.ring + 1, options_.ring + 2}) {
      PillowSet set = try_quads(job, grow(job, ring));
      if (!set.hexes.empty()) return set;
    }
    return {};
  }

  std::vector<QuadId> grow(const Job& job, int ring) const {
    std::vector<QuadId> quads = job.quads;
    for (int k = 0; k < ring; ++k) {
      std::vector<QuadId> next = quads;
      for (QuadId q : quads)
        for (VertId v : state_.quads[q.index()])
          for (QuadId other : marked_.graph.quads(v))
            if (marks_.quad_to_region[other] == job.region) next.push_back(other);
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      quads = std::move(next);
    }
    return quads;
  }

 private:
  std::vector<QuadId> quads_of_region(RegionId region) const {
    std::vector<QuadId> quads;
    for (QuadId q : marks_.quad_to_region.ids())
      if (marks_.quad_to_region[q] == region) quads.push_back(q);
    return quads;
  }

  PillowSet try_quads(const Job& job, const std::vector<QuadId>& quads) {
    PillowSet set;
    for (QuadId q : quads) {
      set.hexes.push_back(state_.quad_face[q.index()].hex);
      is_selected_[q.index()] = 1;
    }
    std::sort(set.hexes.begin(), set.hexes.end());
    set.hexes.erase(std::unique(set.hexes.begin(), set.hexes.end()), set.hexes.end());
    for (HexId h : set.hexes) is_in_[h.index()] = 1;
    collect_faces(set);
    for (VertId v : set.sheet.verts) is_sheet_vert_[v.index()] = 1;
    const bool is_good =
        splits_a_squeezed_vert(job) && keeps_marks(job, set) && find_directions(set);
    for (VertId v : set.sheet.verts) is_sheet_vert_[v.index()] = 0;
    for (HexId h : set.hexes) is_in_[h.index()] = 0;
    for (QuadId q : quads) is_selected_[q.index()] = 0;
    return is_good ? set : PillowSet{};
  }

  void collect_faces(PillowSet& set) const {
    for (HexId h : set.hexes)
      for (int lf = 0; lf < 6; ++lf) {
        const HexId other = state_.neighbors.neighbor[h][static_cast<std::size_t>(lf)];
        if (!other.is_valid() || is_in_[other.index()]) continue;
        set.sheet.quads.push_back(face_verts(state_.mesh, {h, lf}));
        set.sheet.behind.push_back(h);
      }
    set.sheet.verts = sheet_verts(set.sheet.quads);
    set.sheet.depth = kDepth;
  }

  bool splits_a_squeezed_vert(const Job& job) const {
    for (QuadId q : job.quads) {
      const unsigned corners = squeezed_corners(state_, marked_, q, options_.corner_angle);
      for (std::size_t k = 0; k < 4; ++k)
        if ((corners >> k & 1u) != 0 && is_sheet_vert_[state_.quads[q.index()][k].index()])
          return true;
    }
    return false;
  }

  /// The sheet may end on curves and inside the job's region, but not cross anything else.
  bool keeps_marks(const Job& job, const PillowSet& set) const {
    for (VertId v : set.sheet.verts) {
      if (state_.move[v] != MoveIn::Space) return false;
      if (!is_rim(v)) continue;
      for (QuadId q : marked_.graph.quads(v)) {
        if (!is_in_[state_.quad_face[q.index()].hex.index()] || is_selected_[q.index()]) continue;
        if (state_.kind[v] != VertKind::Surface || marks_.quad_to_region[q] != job.region)
          return false;
      }
      for (BoundaryEdgeId e : marked_.graph.edges(v))
        if (marked_.is_marked(e) && is_inside(e)) return false;
    }
    return true;
  }

  bool is_inside(BoundaryEdgeId e) const {
    const auto& edge = marked_.graph.edge(e);
    return edge.num_quads == 2 && is_in_[state_.quad_face[edge.quads[0].index()].hex.index()] &&
           is_in_[state_.quad_face[edge.quads[1].index()].hex.index()];
  }

  /// On the boundary with quads of the set and of others.
  bool is_rim(VertId v) const {
    bool any_in = false, any_out = false;
    for (QuadId q : marked_.graph.quads(v))
      (is_in_[state_.quad_face[q.index()].hex.index()] ? any_in : any_out) = true;
    return any_in && any_out;
  }

  bool find_directions(PillowSet& set) {
    for (VertId v : set.sheet.verts) {
      if (check_.check(v, is_in_, options_.min_cosine) != SetFault::None) return false;
      set.sheet.directions.push_back(check_.direction(v, is_in_).direction);
    }
    return true;
  }

  const FitState& state_;
  const FeatureMarks& marks_;
  const MarkedGraph& marked_;
  const PillowOptions& options_;
  SetCheck check_;
  std::vector<char> is_in_, is_selected_, is_sheet_vert_;
};

/// Jobs that were tried, by (vertex or none, region): ids that survive insertions.
using Tried = std::set<std::pair<VertId, RegionId>>;

std::vector<std::pair<VertId, RegionId>> keys_of(const FitState& state, const MarkedGraph& marked,
                                                 const Job& job, const PillowOptions& options) {
  if (options.whole_regions) return {{VertId{}, job.region}};
  std::vector<std::pair<VertId, RegionId>> keys;
  for (QuadId q : job.quads) {
    const unsigned corners = squeezed_corners(state, marked, q, options.corner_angle);
    for (std::size_t k = 0; k < 4; ++k)
      if ((corners >> k & 1u) != 0) keys.push_back({state.quads[q.index()][k], job.region});
  }
  return keys;
}

/// Squeezed quads that were not tried, by region or, for local pillows, in clusters of a region
/// whose surroundings touch.
class JobMaker {
 public:
  JobMaker(const FitState& state, const FeatureMarks& marks, const MarkedGraph& marked,
           const PillowOptions& options)
      : state_(state), marks_(marks), marked_(marked), options_(options) {}

  std::vector<Job> run(const PillowPlanner& planner, const Tried& tried) {
    for (QuadId q : find_squeezed_quads(state_, marked_, options_.corner_angle)) {
      const auto keys = keys_of(state_, marked_, {marks_.quad_to_region[q], {q}}, options_);
      const bool is_new = std::any_of(keys.begin(), keys.end(),
                                      [&](const auto& key) { return tried.count(key) == 0; });
      if (is_new) quads_.push_back(q);
    }
    parent_.resize(quads_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    join_touching(planner);
    return collect();
  }

 private:
  struct Claim {
    RegionId region;
    VertId vert;  // none for whole regions
    std::size_t quad;
  };

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join_touching(const PillowPlanner& planner) {
    std::vector<Claim> claims;
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const RegionId region = marks_.quad_to_region[quads_[i]];
      if (options_.whole_regions) {
        claims.push_back({region, VertId{}, i});
        continue;
      }
      for (QuadId near : planner.grow({region, {quads_[i]}}, options_.ring))
        for (VertId v : state_.quads[near.index()]) claims.push_back({region, v, i});
    }
    std::sort(claims.begin(), claims.end(), [](const Claim& x, const Claim& y) {
      return std::tie(x.region, x.vert, x.quad) < std::tie(y.region, y.vert, y.quad);
    });
    for (std::size_t k = 1; k < claims.size(); ++k)
      if (claims[k].region == claims[k - 1].region && claims[k].vert == claims[k - 1].vert)
        join(claims[k - 1].quad, claims[k].quad);
  }

  void join(std::size_t i, std::size_t k) {
    const std::size_t a = find(i), b = find(k);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<Job> collect() {
    std::vector<Job> jobs;
    std::vector<std::size_t> job_of(quads_.size());
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const std::size_t root = find(i);
      if (root == i) {
        job_of[i] = jobs.size();
        jobs.push_back({marks_.quad_to_region[quads_[i]], {}});
      }
      jobs[job_of[root]].quads.push_back(quads_[i]);
    }
    return jobs;
  }

  const FitState& state_;
  const FeatureMarks& marks_;
  const MarkedGraph& marked_;
  const PillowOptions& options_;
  std::vector<QuadId> quads_;
  std::vector<std::size_t> parent_;
};

/// Sets without a common vertex, as one.
class Batch {
 public:
  Batch(const FitState& state) : state_(state), is_used_(state.num_verts(), 0) {}

  bool add(const PillowSet& set) {
    for (HexId h : set.hexes)
      for (VertId v : state_.mesh.hexes[h])
        if (is_used_[v.index()]) return false;
    for (HexId h : set.hexes)
      for (VertId v : state_.mesh.hexes[h]) is_used_[v.index()] = 1;
    sets_.push_back(set);
    return true;
  }

  std::size_t size() const { return sets_.size(); }

  std::vector<char> membership() const {
    std::vector<char> is_in(state_.mesh.num_hexes(), 0);
    for (const PillowSet& set : sets_)
      for (HexId h : set.hexes) is_in[h.index()] = 1;
    return is_in;
  }

  Sheet sheet() const {
    Sheet all;
    all.depth = kDepth;
    std::vector<std::pair<VertId, Vec3>> verts;
    for (const PillowSet& set : sets_) {
      all.quads.insert(all.quads.end(), set.sheet.quads.begin(), set.sheet.quads.end());
      all.behind.insert(all.behind.end(), set.sheet.behind.begin(), set.sheet.behind.end());
      for (std::size_t i = 0; i < set.sheet.verts.size(); ++i)
        verts.push_back({set.sheet.verts[i], set.sheet.directions[i]});
    }
    std::sort(verts.begin(), verts.end(),
              [](const auto& x, const auto& y) { return x.first < y.first; });
    for (const auto& [v, direction] : verts) {
      all.verts.push_back(v);
      all.directions.push_back(direction);
    }
    return all;
  }

 private:
  const FitState& state_;
  std::vector<char> is_used_;
  std::vector<PillowSet> sets_;
};

/// Plans and inserts one batch of at most `max_jobs`; false when there was nothing left to do.
bool pillow_batch(FitState& state, FeatureMarks& marks, const PillowOptions& options, Tried& tried,
                  std::size_t& max_jobs, PillowReport& report) {
  const MarkedGraph marked(state, marks);
  PillowPlanner planner(state, marks, marked, options);
  Batch batch(state);
  std::vector<std::pair<VertId, RegionId>> keys;
  for (const Job& job : JobMaker(state, marks, marked, options).run(planner, tried)) {
    const auto job_keys = keys_of(state, marked, job, options);
    const PillowSet set = planner.plan(job);
    if (set.hexes.empty()) {
      tried.insert(job_keys.begin(), job_keys.end());
      ++report.num_skipped;
    } else if (batch.size() < max_jobs && batch.add(set)) {
      keys.insert(keys.end(), job_keys.begin(), job_keys.end());
    }
  }
  if (batch.size() == 0) return false;
  const Sheet sheet = batch.sheet();
  if (insert_behind_set(state, marks, marked, batch.membership(), sheet)) {
    report.num_pillows += batch.size();
    report.num_hexes += sheet.quads.size();
    tried.insert(keys.begin(), keys.end());
  } else if (batch.size() == 1) {
    ++report.num_skipped;
    tried.insert(keys.begin(), keys.end());
  } else {
    max_jobs = 1;  // find the culprit
  }
  return true;
}

}  // namespace

PillowReport pillow_squeezed_quads(FitState& state, FeatureMarks& marks,
                                   const PillowOptions& options) {
  PillowReport report;
  Tried tried;
  std::size_t max_jobs = std::numeric_limits<std::size_t>::max();
  for (int k = 0; k < kMaxBatches; ++k)
    if (!pillow_batch(state, marks, options, tried, max_jobs, report)) break;
  return report;
}

}  // namespace hexwright::fitting
