// The loops of base/parallel.h on threads of the standard library, for builds with the thread
// sanitizer: it understands them, and not the system's TBB, which was built without it. Chunks are
// the same, so results are too; threads are started for each loop, so it is slower.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

std::atomic<int> thread_limit{0};  // 0: one per core
thread_local bool is_worker = false;

/// What the threads of one loop share.
struct Loop {
  std::size_t num_chunks = 0;
  FunctionRef<void(std::size_t)> run_chunk;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;  ///< the first one; chunks not begun then are left out

  void work() {
    const bool was_worker = is_worker;
    is_worker = true;  // loops within chunks run on this thread
    for (std::size_t chunk = next++; chunk < num_chunks; chunk = next++) {
      try {
        run_chunk(chunk);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = num_chunks;
      }
    }
    is_worker = was_worker;
  }
};

}  // namespace

struct ThreadLimit::Impl {
  int before = 0;
};

ThreadLimit::ThreadLimit(int threads) : impl_(new Impl{thread_limit.exchange(threads)}) {}

ThreadLimit::~ThreadLimit() { thread_limit = impl_->before; }

int num_threads() {
  const int limit = thread_limit;
  return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_chunks(std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body) {
  if (count == 0) return;
  const std::atomic<bool>* const flag = CancelScope::flag();
  const auto run_chunk = [&](std::size_t chunk) {
    const CancelScope scope(flag);
    check_cancelled();
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  };
  const std::size_t num_chunks = (count + grain - 1) / grain;
  const std::size_t threads = std::min<std::size_t>(num_chunks, is_worker ? 1 : num_threads());
  if (threads == 1) {
    for (std::size_t chunk = 0; chunk < num_chunks; ++chunk) run_chunk(chunk);
    return;
  }
  Loop loop{num_chunks, run_chunk, {}, {}, {}};
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back([&] { loop.work(); });
  loop.work();
  for (std::thread& other : others) other.join();
  if (loop.error) std::rethrow_exception(loop.error);
}

}  // namespace hexwright
