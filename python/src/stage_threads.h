// Threads that stages run on, kept from call to call: a task scheduler sets up an arena for every
// thread that it meets, and on a busy machine gives the memory of many of them back late or never.
#pragma once

#include <functional>
#include <memory>

namespace hexwright::python {

class StageThread;

/// One of the kept threads, or a new one; goes back to them in the end. Safe from several threads,
/// and in a forked process, which has none of its parent's.
class StageThreadLease {
 public:
  StageThreadLease();
  /// Waits for the job.
  ~StageThreadLease();
  StageThreadLease(const StageThreadLease&) = delete;
  StageThreadLease& operator=(const StageThreadLease&) = delete;

  /// Once per lease. The job must not throw.
  void start(std::function<void()> job);

 private:
  std::unique_ptr<StageThread> thread_;
};

}  // namespace hexwright::python
