// Pillows under squeezed quads, many at a time: sets that share no vertex go in together, so that
// the adjacency is rebuilt once per batch.
#include <algorithm>
#include <set>
#include <tuple>

#include "fit/sheets/feature_layers.h"
#include "fit/sheets/pillow_planner.h"
#include "fit/sheets/relabel.h"
#include "fit/sheets/visible.h"
#include "geometry/surface_edges.h"

namespace hexwright::fitting {
namespace {

constexpr int kMaxBatches = 60;
constexpr std::size_t kMaxJobs = 1 << 20;  // in a batch

/// Jobs that were tried, by (vertex or none, region): ids that survive insertions.
using Tried = std::set<std::pair<VertId, RegionId>>;

bool is_wanted(const PillowOptions& options, VertId v) {
  if (options.is_wanted.empty()) return true;
  return v.index() < options.is_wanted.size() && options.is_wanted[v.index()] != 0;
}

/// Of the corners a job is about.
std::vector<std::pair<VertId, RegionId>> keys_of(const FitState& state, const MarkedGraph& marked,
                                                 const PillowJob& job,
                                                 const PillowOptions& options) {
  if (options.whole_regions) return {{VertId{}, job.region}};
  std::vector<std::pair<VertId, RegionId>> keys;
  for (QuadId q : job.quads) {
    const unsigned corners = squeezed_corners(state, marked, q, options.corner_angle);
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId v = state.quads[q.index()][k];
      if ((corners >> k & 1u) != 0 && is_wanted(options, v)) keys.push_back({v, job.region});
    }
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

  std::vector<PillowJob> run(const PillowPlanner& planner, const Tried& tried) {
    for (QuadId q : find_squeezed_quads(state_, marked_, options_.corner_angle)) {
      const auto keys = keys_of(state_, marked_, {marks_.quad_to_region[q], {q}}, options_);
      const bool is_new = std::any_of(keys.begin(), keys.end(),
                                      [&](const auto& key) { return tried.count(key) == 0; });
      if (is_new) quads_.push_back(q);
    }
    UnionFind sets(quads_.size());
    join_touching(planner, sets);
    return collect(sets);
  }

 private:
  struct Claim {
    RegionId region;
    VertId vert;  // none for whole regions
    std::size_t quad;
  };

  void join_touching(const PillowPlanner& planner, UnionFind& sets) const {
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
        sets.unite(static_cast<int>(claims[k - 1].quad), static_cast<int>(claims[k].quad));
  }

  std::vector<PillowJob> collect(UnionFind& sets) const {
    std::vector<PillowJob> jobs;
    std::vector<std::size_t> job_of(quads_.size());
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const auto root = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
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
};

/// Sets without a common vertex, as one.
class Batch {
 public:
  Batch(const FitState& state) : state_(state), is_used_(state.num_verts(), 0) {}

  bool add(const std::vector<HexId>& hexes) {
    for (HexId h : hexes)
      for (VertId v : state_.mesh.hexes[h])
        if (is_used_[v.index()]) return false;
    for (HexId h : hexes)
      for (VertId v : state_.mesh.hexes[h]) is_used_[v.index()] = 1;
    hexes_.insert(hexes_.end(), hexes.begin(), hexes.end());
    ++num_sets_;
    return true;
  }

  std::size_t size() const { return num_sets_; }

  /// The sheet between the sets and the other hexes; the sets' boundary quads follow.
  SheetPlan plan() const {
    SheetPlan plan;
    plan.takes_copy.assign(state_.mesh.num_hexes(), 0);
    for (HexId h : hexes_) plan.takes_copy[h.index()] = 1;
    for (const HexFace& face : state_.quad_face)
      plan.follows.push_back(plan.takes_copy[face.hex.index()]);
    plan.sheet.add_inner_faces(state_.mesh, state_.neighbors, hexes_, plan.takes_copy);
    plan.sheet.collect_verts();
    for (const auto& visible : find_visible_directions(state_.mesh, plan.sheet))
      plan.directions.push_back(visible.direction);
    return plan;
  }

 private:
  const FitState& state_;
  std::vector<char> is_used_;  // per vertex
  std::vector<HexId> hexes_;
  std::size_t num_sets_ = 0;
};

/// Plans and inserts one batch of at most `max_jobs`; false when there was nothing left to do.
bool pillow_batch(FitState& state, FeatureMarks& marks, const PillowOptions& options, Tried& tried,
                  std::size_t& max_jobs, PillowReport& report) {
  const MarkedGraph marked(state, marks);
  PillowPlanner planner(state, marks, marked, options);
  Batch batch(state);
  std::vector<std::pair<VertId, RegionId>> keys;
  for (const PillowJob& job : JobMaker(state, marks, marked, options).run(planner, tried)) {
    const auto job_keys = keys_of(state, marked, job, options);
    const std::vector<HexId> set = planner.plan(job);
    if (set.empty()) {
      tried.insert(job_keys.begin(), job_keys.end());
      ++report.num_skipped;
    } else if (batch.size() < max_jobs && batch.add(set)) {
      keys.insert(keys.end(), job_keys.begin(), job_keys.end());
    }
  }
  if (batch.size() == 0) return false;
  const SheetPlan plan = batch.plan();
  if (!apply_plan(state, marks, marked, plan).copies.empty()) {
    report.num_pillows += batch.size();
    report.num_hexes += plan.sheet.quads.size();
    tried.insert(keys.begin(), keys.end());
    max_jobs = std::min(max_jobs, kMaxJobs / 2) * 2;
  } else if (batch.size() == 1) {
    ++report.num_skipped;
    tried.insert(keys.begin(), keys.end());
  } else {
    max_jobs = batch.size() / 2;  // find the culprit by halving
  }
  return true;
}

}  // namespace

PillowReport pillow_squeezed_quads(FitState& state, FeatureMarks& marks,
                                   const PillowOptions& options) {
  PillowReport report;
  Tried tried;
  std::size_t max_jobs = kMaxJobs;
  for (int k = 0; k < kMaxBatches; ++k)
    if (!pillow_batch(state, marks, options, tried, max_jobs, report)) break;
  return report;
}

}  // namespace hexwright::fitting
