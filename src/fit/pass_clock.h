// Names the passes of a stage as they run: progress to the caller, wall time to the report.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "hexwright/base/context.h"

namespace hexwright::fitting {

class PassClock {
 public:
  using Seconds = std::vector<std::pair<std::string, double>>;

  PassClock(const Context& context, Seconds& seconds) : context_(context), seconds_(seconds) {}

  /// Runs one pass; passes of one name add up.
  template <class Pass>
  void run(const std::string& name, double progress, Pass&& pass) {
    context_.check_cancelled();
    context_.progress("fit: " + name, progress);
    const auto start = std::chrono::steady_clock::now();
    pass();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    for (auto& [known, total] : seconds_)
      if (known == name) {
        total += spent.count();
        return;
      }
    seconds_.emplace_back(name, spent.count());
  }

 private:
  const Context& context_;
  Seconds& seconds_;
};

}  // namespace hexwright::fitting
