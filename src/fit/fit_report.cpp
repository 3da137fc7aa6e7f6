// Maps what a fit reports to the world.
#include <utility>

#include "hexwright/fit/fit.h"

namespace hexwright {

void FitReport::to_world(const Similarity& frame) {
  carve.to_world(frame);
  curve_length = frame.length_to_world(curve_length);
  curve_length_mapped = frame.length_to_world(curve_length_mapped);
  for (CurveOutcome& curve : curves) curve.to_world(frame);
  for (Miss& miss : misses) miss.to_world(frame);
}

void FitResult::to_world(const Similarity& frame) {
  mesh = hexwright::to_world(std::move(mesh), frame);
  report.to_world(frame);
}

}  // namespace hexwright
