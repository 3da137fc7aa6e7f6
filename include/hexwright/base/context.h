// What a stage may tell its caller while it runs, and how the caller stops it.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include "hexwright/base/error.h"

namespace hexwright {

/// Passed to every stage. The library itself never prints.
struct Context {
  /// Called with the stage's name and a fraction in [0, 1]; may be empty.
  std::function<void(std::string_view stage, double fraction)> on_progress;
  /// Called with one-sentence warnings about the input or the result; may be empty.
  std::function<void(std::string_view message)> on_warning;
  /// Set to true from any thread to stop the stage at its next check; may be null.
  const std::atomic<bool>* cancel = nullptr;

  void progress(std::string_view stage, double fraction) const {
    if (on_progress) on_progress(stage, fraction);
  }
  void warn(std::string_view message) const {
    if (on_warning) on_warning(message);
  }
  /// Throws Error{Cancelled} when the caller asked to stop.
  void check_cancelled() const {
    if (cancel && cancel->load(std::memory_order_relaxed))
      throw Error(ErrorCode::Cancelled, "cancelled by the caller");
  }
};

}  // namespace hexwright
