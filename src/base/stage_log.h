// Seconds and counts of the stages as they run.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/base/stage_record.h"

namespace hexwright {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs a stage, notes its time, and checks for cancellation before it.
template <class Stage>
auto run_stage(std::vector<StageRecord>& log, std::string name, const Context& context,
               Stage&& stage) {
  context.check_cancelled();
  const Stopwatch clock;
  auto result = std::forward<Stage>(stage)();
  log.push_back({std::move(name), clock.seconds(), {}});
  return result;
}

}  // namespace hexwright
