// Sheets under squeezed quads, many at a time: sets that share no vertex go in together, so that
// the adjacency is rebuilt once per batch.
#include "fit/sheets/squeezed.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "fit/sheets/relabel.h"
#include "fit/sheets/squeezed_planner.h"
#include "fit/sheets/visible.h"
#include "geometry/topology/surface_edges.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

double angle_at(const FitState& state, const std::array<VertId, 4>& quad, std::size_t k) {
  const Vec3& o = state.mesh.positions[quad[k]];
  const Vec3 a = normalized(state.mesh.positions[quad[(k + 1) % 4]] - o);
  const Vec3 b = normalized(state.mesh.positions[quad[(k + 3) % 4]] - o);
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

constexpr int kMaxBatches = 60;
constexpr std::size_t kMaxJobs = 1 << 20;  // in a batch

/// Jobs that were tried, by (vertex or none, region): ids that survive insertions.
using Tried = std::set<std::pair<VertId, RegionId>>;

bool is_wanted(const SqueezedOptions& options, VertId v) {
  if (options.is_wanted.empty()) return true;
  return v.index() < options.is_wanted.size() && options.is_wanted[v.index()] != 0;
}

/// Of the corners a job is about.
std::vector<std::pair<VertId, RegionId>> keys_of(const FitState& state,
                                                 const BoundaryState& boundary,
                                                 const SqueezedJob& job,
                                                 const SqueezedOptions& options) {
  if (options.whole_regions) return {{VertId{}, job.region}};
  std::vector<std::pair<VertId, RegionId>> keys;
  for (QuadId q : job.quads) {
    const unsigned corners = squeezed_corners(state, boundary, q, options.corner_angle);
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId v = state.quads[q.index()][k];
      if ((corners >> k & 1u) != 0 && is_wanted(options, v)) keys.push_back({v, job.region});
    }
  }
  return keys;
}

/// Squeezed quads that were not tried, by region or, for local sheets, in clusters of a region
/// whose surroundings touch.
class JobMaker {
 public:
  JobMaker(const FitState& state, const BoundaryState& boundary, const SqueezedOptions& options)
      : state_(state), boundary_(boundary), options_(options) {}

  std::vector<SqueezedJob> run(const SqueezedPlanner& planner, const Tried& tried) {
    for (QuadId q : find_squeezed_quads(state_, boundary_, options_.corner_angle)) {
      const auto keys = keys_of(state_, boundary_, {boundary_.quad_to_region[q], {q}}, options_);
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

  void join_touching(const SqueezedPlanner& planner, UnionFind& sets) const {
    std::vector<Claim> claims;
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const RegionId region = boundary_.quad_to_region[quads_[i]];
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

  std::vector<SqueezedJob> collect(UnionFind& sets) const {
    std::vector<SqueezedJob> jobs;
    std::vector<std::size_t> job_of(quads_.size());
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const auto root = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
      if (root == i) {
        job_of[i] = jobs.size();
        jobs.push_back({boundary_.quad_to_region[quads_[i]], {}});
      }
      jobs[job_of[root]].quads.push_back(quads_[i]);
    }
    return jobs;
  }

  const FitState& state_;
  const BoundaryState& boundary_;
  const SqueezedOptions& options_;
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
bool pad_batch(FitState& state, BoundaryState& boundary, const SqueezedOptions& options,
               Tried& tried, std::size_t& max_jobs, SqueezedReport& report) {
  SqueezedPlanner planner(state, boundary, options);
  Batch batch(state);
  std::vector<std::pair<VertId, RegionId>> keys;
  for (const SqueezedJob& job : JobMaker(state, boundary, options).run(planner, tried)) {
    const auto job_keys = keys_of(state, boundary, job, options);
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
  if (!apply_plan(state, boundary, plan).copies.empty()) {
    report.num_sheets += batch.size();
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

unsigned squeezed_corners(const FitState& state, const BoundaryState& boundary, QuadId q,
                          double corner_angle) {
  const auto& quad = state.quads[q.index()];
  const auto& edges = boundary.graph.quad_edges(q);
  unsigned result = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!boundary.is_marked(edges[k]) || !boundary.is_marked(edges[(k + 3) % 4])) continue;
    const VertKind kind = state.kind[quad[k]];
    if (kind == VertKind::Curve ||
        (kind == VertKind::Corner && angle_at(state, quad, k) > corner_angle))
      result |= 1u << k;
  }
  return result;
}

std::vector<QuadId> find_squeezed_quads(const FitState& state, const BoundaryState& boundary,
                                        double corner_angle) {
  std::vector<QuadId> result;
  for (QuadId q : id_range<QuadId>(state.quads.size()))
    if (squeezed_corners(state, boundary, q, corner_angle) != 0) result.push_back(q);
  return result;
}

SqueezedReport pad_squeezed_quads(FitState& state, BoundaryState& boundary,
                                  const SqueezedOptions& options) {
  SqueezedReport report;
  Tried tried;
  std::size_t max_jobs = kMaxJobs;
  for (int k = 0; k < kMaxBatches; ++k)
    if (!pad_batch(state, boundary, options, tried, max_jobs, report)) break;
  return report;
}

}  // namespace hexwright::fitting
