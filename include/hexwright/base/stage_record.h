// Seconds and counts of a run's stages.
#pragma once

#include <map>
#include <string>

namespace hexwright {

/// Seconds and counts of one stage.
struct StageRecord {
  std::string name;
  double seconds = 0;
  std::map<std::string, double> counts;
};

}  // namespace hexwright
