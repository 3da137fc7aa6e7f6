// A few poor hexes with what surrounds them, solved as one: all their vertices move together,
// boundary vertices within a ball around where they belong.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relax/joint/energy.h"
#include "relax/joint/region.h"

namespace hexwright::relax {

/// How far a stage lets go of the surface; lengths.
struct JointStage {
  double slack = 0;         ///< of surface vertices along the normal; others have a share of it
  double quad_sag = 0;      ///< allowed from the middles of quads and of their edges to the surface
  double curve_sag = 0;     ///< allowed from the middles of curve edges to the curve
  double corner_slack = 0;  ///< of corners at most
  double goal = 0;          ///< least scaled Jacobian to be content with
  double reach = 0;         ///< how far curve vertices may slide, in h
  bool is_patient = false;  ///< goes on where the bluntest energy raised nothing
};

/// Where a movable vertex is and what it is attached to there.
struct JointPlace {
  Vec3 position;
  Vec3 target, direction;  ///< as in FitState
  Vec3 asked_from;         ///< of surface vertices: where the target was looked up
  double arc = 0;          ///< of curve vertices
};

/// Solves one region.
class JointPatch {
 public:
  /// Keeps references. Requires current targets.
  JointPatch(const FitState& state, const FitTarget& target, const JointRegion& region);

  /// Raises the least scaled Jacobian of the region's hexes; false, and nothing happened, when no
  /// better place was found that the guard lets pass. Reads the state only.
  bool solve(const JointStage& stage);

  /// By how much the solution changes the volume of the region's hexes.
  double volume_change() const;

  /// Takes the solution over: positions, targets, arcs.
  void apply(FitState& state) const;

 private:
  struct Iterate {
    double least = 0;
    std::vector<JointPlace> places;
  };

  void set_balls(const JointStage& stage);
  void set_freedom();
  void settle(std::size_t i, JointPlace& place) const;
  void settle_on_surface(std::size_t i, JointPlace& place) const;
  void settle_on_curve(std::size_t i, JointPlace& place) const;
  Vec3 off_of(std::size_t i, const JointPlace& place) const;
  void load(const std::vector<JointPlace>& places);
  JointValue descend(JointEnergy& energy, double sharpness, double enough,
                     std::vector<Iterate>& found);
  std::optional<JointValue> try_step(JointEnergy& energy, std::span<const Vec3> step,
                                     double sharpness, double energy_now);

  const FitState& state_;
  const FitTarget& target_;
  const JointRegion& region_;
  std::vector<double> slack_, radius_;  // per movable vertex: of the stage, and with what it had
  double reach_ = 0;
  std::vector<JointPlace> start_, places_, trial_;  // of the movable vertices
  std::vector<Vec3> positions_;                     // of all
  std::vector<JointFreedom> freedom_, trial_freedom_;
};

}  // namespace hexwright::relax
