// The calling thread alone may look at signals (Python's rule), and a stage may hold it for hours:
// so the stage has a thread of its own.
#include "run_stage.h"

#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "hexwright/base/parallel.h"

#include "stage_threads.h"

namespace hexwright::python {
namespace {

namespace nb = nanobind;
constexpr std::chrono::milliseconds kLook{50};

/// What the two threads share.
class Run {
 public:
  explicit Run(bool wants_progress) {
    context_.cancel = &cancel_;
    context_.on_warning = [this](std::string_view message) {
      const std::lock_guard lock(mutex_);
      warnings_.emplace_back(message);
    };
    if (wants_progress)
      context_.on_progress = [this](std::string_view stage, double fraction) {
        note(stage, fraction);
      };
  }

  void work(const std::function<void(const Context&)>& work, int threads) {
    std::fesetenv(FE_DFL_ENV);  // other modules make threads flush denormals; results would differ
    try {
      std::unique_ptr<ThreadLimit> limit;
      if (threads > 0) limit = std::make_unique<ThreadLimit>(threads);
      work(context_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_done_ = true;
    changed_.notify_one();
  }

  using Events = std::vector<std::pair<std::string, double>>;
  /// Waits for the end or the next look; true at the end.
  bool wait(Events& events) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kLook, [this] { return is_done_; });
    events = std::exchange(events_, {});
    return is_done_;
  }

  void cancel() { cancel_ = true; }
  const std::exception_ptr& failure() const { return failure_; }
  std::vector<std::string> take_warnings() { return std::move(warnings_); }

 private:
  /// Each stage is told, and of its fractions the last.
  void note(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    if (!events_.empty() && events_.back().first == stage)
      events_.back().second = fraction;
    else
      events_.emplace_back(stage, fraction);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  std::atomic<bool> cancel_{false};
  Context context_;
  Events events_;
  std::vector<std::string> warnings_;
  std::exception_ptr failure_;
};

/// Signals and progress; false to cancel.
bool serve_python(const nb::object& progress, const Run::Events& events) {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  bool goes_on = true;
  for (const auto& [stage, fraction] : events)
    if (progress(stage.c_str(), fraction).is(nb::bool_(false))) goes_on = false;
  return goes_on;
}

}  // namespace

std::vector<std::string> run_stage(const RunSettings& settings,
                                   const std::function<void(const Context&)>& work) {
  Run run(!settings.progress.is_none());
  std::exception_ptr callers;  // of the signal's handler or of progress
  std::optional<StageThreadLease> worker(std::in_place);
  worker->start([&] { run.work(work, settings.threads); });
  for (bool is_done = false; !is_done;) {
    Run::Events events;
    {
      const nb::gil_scoped_release released;
      is_done = run.wait(events);
    }
    if (callers) continue;
    try {
      if (!serve_python(settings.progress, events)) run.cancel();
    } catch (...) {
      callers = std::current_exception();
      run.cancel();
    }
  }
  {
    const nb::gil_scoped_release released;
    worker.reset();
  }
  if (callers) std::rethrow_exception(callers);
  if (run.failure()) std::rethrow_exception(run.failure());
  return run.take_warnings();
}

}  // namespace hexwright::python
