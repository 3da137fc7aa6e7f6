// How the loops of a computation learn that the caller wants it to end.
#pragma once

#include <atomic>

namespace hexwright {

/// While it lives, loops of this thread and of the workers they start look at `flag` (null: at
/// none), and end with Error{Cancelled} once it is true. Functions that take a Context watch its
/// flag so (Context::watch); callers of functions without one, such as readers, open a scope
/// themselves. Scopes of a thread end in the reverse order of their beginning.
class CancelScope {
 public:
  explicit CancelScope(const std::atomic<bool>* flag) noexcept;
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  /// The flag of this thread's innermost scope, null without one.
  static const std::atomic<bool>* flag() noexcept;

 private:
  const std::atomic<bool>* outer_;
};

/// Throws Error{Cancelled} when the flag of this thread's innermost scope is true. Takes about a
/// nanosecond.
void check_cancelled();

/// For loops whose steps are shorter than the look at the flag: looks at every 1024th call.
class CancelCheck {
 public:
  void operator()() {
    if ((++count_ & 1023u) == 0) check_cancelled();
  }

 private:
  unsigned count_ = 0;
};

}  // namespace hexwright
