#include "relax/joint/patch.h"

#include <algorithm>

#include "hexwright/quality/hex_quality.h"

#include "relax/joint/guard.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

constexpr double kSharpness[] = {25, 60, 150};
constexpr int kStepsPerSharpness = 10, kMaxTries = 4;
constexpr double kFirstDamping = 1e-3, kLessDamping = 0.4, kMoreDamping = 5;
constexpr double kLongestStep = 0.25;    // in h
constexpr double kLeastPositive = 1e-3;  // scaled Jacobian that no step goes below
constexpr double kBeyondGoal = 0.01;
constexpr double kLeastGain = 0.005;   // of a solution that is taken
constexpr double kIterateGain = 0.01;  // between iterates that are worth a look
constexpr double kNoProgress = 1e-4;   // of the energy, in one step

// Shares of the slack along the normal, and the largest balls in h.
constexpr double kSurfaceBall = 0.25, kCurveShare = 0.4, kCurveBall = 0.2, kCornerShare = 0.2;

Vec3 shorten(const Vec3& v, double length) {
  const double now = norm(v);
  return now > length ? v * (length / now) : v;
}

}  // namespace

JointPatch::JointPatch(const FitState& state, const FitTarget& target, const JointRegion& region)
    : state_(state), target_(target), region_(region), positions_(region.verts().size()) {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    positions_[i] = state.mesh.positions[region.verts()[i]];
  for (std::size_t i = 0; i < region.num_movable(); ++i) {
    const VertId v = region.verts()[i];
    start_.push_back({positions_[i], state.target[v], normalized(state.direction[v]),
                      state.query[v].from, state.arc[v]});
  }
}

// From where the vertex belongs to where it is, without the way along the surface or curve.
Vec3 JointPatch::off_of(std::size_t i, const JointPlace& place) const {
  const Vec3 y = place.position - place.target;
  switch (state_.kind[region_.verts()[i]]) {
    case VertKind::Interior:
      return {};
    case VertKind::Surface:
      return dot(y, place.direction) * place.direction;
    case VertKind::Curve:
      return y - dot(y, place.direction) * place.direction;
    case VertKind::Corner:
      return y;
  }
  return {};
}

// What is farther off already keeps what it has.
void JointPatch::set_balls(const JointStage& stage) {
  slack_.assign(start_.size(), 0);
  radius_.assign(start_.size(), 0);
  reach_ = stage.reach;
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const VertId v = region_.verts()[i];
    const double h = state_.size[v];
    switch (state_.kind[v]) {
      case VertKind::Interior:
        continue;
      case VertKind::Surface:
        slack_[i] = std::min(stage.slack, kSurfaceBall * h);
        break;
      case VertKind::Curve:
        slack_[i] = std::min(kCurveShare * stage.slack, kCurveBall * h);
        break;
      case VertKind::Corner:
        slack_[i] = std::min(kCornerShare * stage.slack, stage.corner_slack);
        break;
    }
    radius_[i] = std::max(slack_[i], norm(off_of(i, start_[i])));
  }
}

void JointPatch::set_freedom() {
  freedom_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const VertId v = region_.verts()[i];
    freedom_[i] = {state_.kind[v], places_[i].direction, {}, 0, state_.size[v]};
    if (!(slack_[i] > 0)) continue;
    freedom_[i].slack = radius_[i];
    freedom_[i].off = off_of(i, places_[i]);
  }
}

void JointPatch::settle_on_surface(std::size_t i, JointPlace& place) const {
  const VertId v = region_.verts()[i];
  const double h = state_.size[v];
  if (norm_sq(place.position - place.asked_from) > kSamePlace * kSamePlace * h * h) {
    SurfaceSeeker seeker = {place.position, place.direction, h, state_.patch[v], state_.offset[v]};
    seeker.bound =
        (1 + 1e-6) * (distance(place.position, place.target) + std::abs(state_.offset[v])) +
        1e-9 * h;
    if (const auto match = match_surface(seeker, target_)) {
      place.target = match->target;
      place.direction = match->direction;
      place.asked_from = place.position;
    }
  }
  const double off = dot(place.position - place.target, place.direction);
  place.position += (std::clamp(off, -radius_[i], radius_[i]) - off) * place.direction;
}

// Curve vertices stay within reach of where the solve found them.
void JointPatch::settle_on_curve(std::size_t i, JointPlace& place) const {
  const VertId v = region_.verts()[i];
  const double reach = reach_ * state_.size[v];
  const CurvePoint p =
      closest_on_curve(target_.tree.surface(), target_.features->curves[state_.curve[v]],
                       place.position, start_[i].arc - reach, start_[i].arc + reach);
  place.target = p.point;
  place.direction = p.tangent;
  place.arc = p.arc;
  place.position = p.point + shorten(off_of(i, place), radius_[i]);
}

void JointPatch::settle(std::size_t i, JointPlace& place) const {
  switch (state_.kind[region_.verts()[i]]) {
    case VertKind::Interior:
      return;
    case VertKind::Surface:
      return settle_on_surface(i, place);
    case VertKind::Curve:
      return settle_on_curve(i, place);
    case VertKind::Corner:
      place.position = place.target + shorten(place.position - place.target, radius_[i]);
      return;
  }
}

void JointPatch::load(const std::vector<JointPlace>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) positions_[i] = places[i].position;
}

std::optional<JointValue> JointPatch::try_step(JointEnergy& energy, std::span<const Vec3> step,
                                               double sharpness, double energy_now) {
  trial_ = places_;
  for (std::size_t i = 0; i < trial_.size(); ++i) {
    if (step[i] == Vec3{}) continue;
    trial_[i].position += step[i];
    settle(i, trial_[i]);
  }
  load(trial_);
  trial_freedom_ = freedom_;
  for (std::size_t i = 0; i < trial_.size(); ++i)
    if (freedom_[i].slack > 0) trial_freedom_[i].off = off_of(i, trial_[i]);
  const JointValue value = energy.evaluate(positions_, trial_freedom_, sharpness);
  if (value.least > kLeastPositive && value.energy < energy_now) return value;
  load(places_);
  return {};
}

JointValue JointPatch::descend(JointEnergy& energy, double sharpness, double enough,
                               std::vector<Iterate>& found) {
  set_freedom();
  JointValue now = energy.evaluate(positions_, freedom_, sharpness);
  double damping = kFirstDamping;
  for (int k = 0; k < kStepsPerSharpness && now.least < enough; ++k) {
    energy.linearize(positions_, freedom_, sharpness);
    std::optional<JointValue> next;
    for (int attempt = 0; attempt < kMaxTries && !next; ++attempt) {
      next = try_step(energy, energy.step(freedom_, damping, kLongestStep), sharpness, now.energy);
      damping *= next ? kLessDamping : kMoreDamping;
    }
    if (!next) break;
    std::swap(places_, trial_);
    const bool is_progress = now.energy - next->energy > kNoProgress;
    now = *next;
    if (now.least >= found.back().least + kIterateGain || now.least >= enough)
      found.push_back({now.least, places_});
    if (!is_progress) break;
    set_freedom();
    now = energy.evaluate(positions_, freedom_, sharpness);
  }
  return now;
}

bool JointPatch::solve(const JointStage& stage) {
  set_balls(stage);
  places_ = start_;
  load(places_);
  JointEnergy energy(region_.shape());
  set_freedom();
  const double least = energy.evaluate(positions_, freedom_, kSharpness[0]).least;
  const double enough = stage.goal + kBeyondGoal;
  std::vector<Iterate> found = {{least, start_}};
  for (double sharpness : kSharpness) {
    const JointValue value = descend(energy, sharpness, enough, found);
    // What the bluntest energy does not raise is mostly bounded by more than its neighbours.
    if (value.least >= enough || (!stage.is_patient && value.least < least + kLeastGain)) break;
  }

  JointGuard guard(state_, target_, region_);
  for (; found.size() > 1 && found.back().least >= least + kLeastGain; found.pop_back()) {
    load(found.back().places);
    if (!guard.allows(positions_, stage)) continue;
    places_ = std::move(found.back().places);
    return true;
  }
  return false;
}

double JointPatch::volume_change() const {
  std::vector<Vec3> after(region_.verts().size());
  for (std::size_t i = 0; i < after.size(); ++i)
    after[i] = i < places_.size() ? places_[i].position : state_.mesh.positions[region_.verts()[i]];
  double change = 0;
  for (std::size_t k = 0; k < region_.hexes().size(); ++k) {
    std::array<Vec3, 8> corners;
    for (std::size_t lv = 0; lv < 8; ++lv) corners[lv] = after[region_.local_hexes()[k][lv]];
    change += hex_volume(corners) - hex_volume(state_.mesh.corners(region_.hexes()[k]));
  }
  return change;
}

void JointPatch::apply(FitState& state) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const VertId v = region_.verts()[i];
    const JointPlace& place = places_[i];
    state.mesh.positions[v] = place.position;
    state.is_dirty[v] = 1;
    if (state.kind[v] == VertKind::Interior) continue;
    state.target[v] = place.target;
    state.direction[v] = place.direction;
    state.query[v].from = place.asked_from;
    state.arc[v] = place.arc;
  }
}

}  // namespace hexwright::relax
