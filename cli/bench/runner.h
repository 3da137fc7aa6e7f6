// Evaluates models in processes of their own, several at a time, each within limits.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hexwright/base/context.h"

#include "bench/bench_options.h"
#include "bench/results.h"

namespace hexwright::cli {

struct RunnerOptions {
  std::filesystem::path executable;  ///< this program
  std::filesystem::path out;
  int jobs = 1;
  int threads_per_job = 1;
  std::size_t memory_per_job = 0;  ///< MiB, 0 = no limit
  double seconds_per_model = 600;
  BenchOptions bench;
};

/// Evaluates the models one after the other, `jobs` at a time, and leaves a finished record of
/// each: of those that crash, hang or outgrow the memory one that says so, with the parts done
/// until then. `on_finished` sees each record. Throws Error{Cancelled} on request, having ended all
/// processes.
void run_models(const std::vector<BenchModel>& models, const RunnerOptions& options,
                const Context& context, const std::function<void(const Json&)>& on_finished);

}  // namespace hexwright::cli
