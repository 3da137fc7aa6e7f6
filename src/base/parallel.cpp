// Based on: oneTBB. Chunks of a fixed size are the unit of work, so that what a chunk computes
// never depends on threads.
#include "hexwright/base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "hexwright/base/cancel.h"

namespace hexwright {

struct ThreadLimit::Impl {
  explicit Impl(std::size_t threads)
      : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  const int wanted = threads > 0 ? threads : tbb::info::default_concurrency();
  impl_ = std::make_unique<Impl>(static_cast<std::size_t>(wanted));
}

ThreadLimit::~ThreadLimit() = default;

int num_threads() {
  const auto limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(limit);
}

void parallel_chunks(std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body) {
  if (count == 0) return;
  const std::size_t num_chunks = (count + grain - 1) / grain;
  const std::atomic<bool>* const flag = CancelScope::flag();
  const auto run_chunk = [&](std::size_t chunk) {
    const CancelScope scope(flag);
    check_cancelled();
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  };
  if (num_chunks == 1 || num_threads() == 1) {
    for (std::size_t chunk = 0; chunk < num_chunks; ++chunk) run_chunk(chunk);
    return;
  }
  // Workers round and treat denormals as the caller does. Without this a loop inherits whatever
  // mode was set when the workers started, for example by a library that flushes denormals.
  using TbbContext = tbb::task_group_context;
  TbbContext context(TbbContext::bound, TbbContext::default_traits | TbbContext::fp_settings);
  tbb::parallel_for(std::size_t{0}, num_chunks, run_chunk, context);
}

}  // namespace hexwright
