// Names the passes of a stage as they run: progress to the caller, times to the report.
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "hexwright/base/context.h"

namespace hexwright::fitting {

class PassClock {
 public:
  using Seconds = std::vector<std::pair<std::string, double>>;

  /// `processor_seconds` counts those of the whole process, so also of other jobs in it.
  PassClock(const Context& context, Seconds& seconds, Seconds& processor_seconds)
      : context_(context), seconds_(seconds), processor_seconds_(processor_seconds) {}

  /// Runs one pass; passes of one name add up.
  template <class Pass>
  void run(const std::string& name, double progress, Pass&& pass) {
    context_.check_cancelled();
    context_.progress("fit: " + name, progress);
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    pass();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    add(seconds_, name, spent.count());
    add(processor_seconds_, name,
        static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC);
  }

 private:
  static void add(Seconds& totals, const std::string& name, double seconds) {
    for (auto& [known, total] : totals)
      if (known == name) {
        total += seconds;
        return;
      }
    totals.emplace_back(name, seconds);
  }

  const Context& context_;
  Seconds& seconds_;
  Seconds& processor_seconds_;
};

}  // namespace hexwright::fitting
