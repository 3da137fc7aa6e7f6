// What a stage may tell its caller while it runs, and how the caller stops it.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include "hexwright/base/cancel.h"
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
  /// Throws Error{Cancelled} when the caller asked to stop: by the flag of this context or, where
  /// it has none, of the scope around (base/cancel.h).
  void check_cancelled() const {
    const auto scope = watch();
    hexwright::check_cancelled();
  }
  /// While the result lives, loops below look at the flag, or at that of the scope around when this
  /// context has none.
  [[nodiscard]] CancelScope watch() const {
    return CancelScope(cancel ? cancel : CancelScope::flag());
  }
};

}  // namespace hexwright
