#include "stage_threads.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <pthread.h>

namespace hexwright::python {

/// Runs one job after another.
class StageThread {
 public:
  StageThread() : thread_([this] { run(); }) {}
  ~StageThread() {
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void start(std::function<void()> job) {
    {
      const std::lock_guard lock(mutex_);
      job_ = std::move(job);
    }
    changed_.notify_all();
  }

  void wait() {
    std::unique_lock lock(mutex_);
    wait_for(lock, [this] { return !job_; });
  }

 private:
  /// Waiting without a limit needs a newer C++ library than the wheel asks for.
  template <class Condition>
  void wait_for(std::unique_lock<std::mutex>& lock, Condition holds) {
    while (!changed_.wait_for(lock, std::chrono::hours(1), holds)) {
    }
  }

  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      wait_for(lock, [this] { return is_ending_ || job_; });
      if (!job_) return;
      lock.unlock();
      job_();
      lock.lock();
      job_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  bool is_ending_ = false;
  std::thread thread_;  // last: it uses the others
};

namespace {

/// The idle ones. In a forked process they are forgotten, not ended: they do not run there.
class IdleThreads {
 public:
  std::unique_ptr<StageThread> take() {
    const std::lock_guard lock(mutex_);
    if (threads_.empty()) return std::make_unique<StageThread>();
    auto thread = std::move(threads_.back());
    threads_.pop_back();
    return thread;
  }

  void give_back(std::unique_ptr<StageThread> thread) {
    const std::lock_guard lock(mutex_);
    threads_.push_back(std::move(thread));
  }

  /// Around a fork, so that no other thread is in here meanwhile.
  void lock() { mutex_.lock(); }
  void unlock() { mutex_.unlock(); }
  void forget() {
    for (auto& thread : threads_) static_cast<void>(thread.release());
    threads_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<StageThread>> threads_;
};

IdleThreads& idle_threads() {
  static IdleThreads threads;
  [[maybe_unused]] static const int watched =
      pthread_atfork([] { idle_threads().lock(); }, [] { idle_threads().unlock(); },
                     [] {
                       idle_threads().forget();
                       idle_threads().unlock();
                     });
  return threads;
}

}  // namespace

StageThreadLease::StageThreadLease() : thread_(idle_threads().take()) {}

StageThreadLease::~StageThreadLease() {
  thread_->wait();
  idle_threads().give_back(std::move(thread_));
}

void StageThreadLease::start(std::function<void()> job) { thread_->start(std::move(job)); }

}  // namespace hexwright::python
