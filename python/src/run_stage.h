// Runs a stage for Python: without the interpreter's lock, with progress, and so that Ctrl-C stops
// it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "hexwright/base/context.h"

namespace hexwright::python {

/// What every call that works may be told.
struct RunSettings {
  nanobind::object progress;  ///< called as progress(stage, fraction); None = nobody asks
  int threads = 0;            ///< 0 = one per core
};

/// Runs `work` on a thread of its own while the calling one serves Python: signals are looked at,
/// and progress is told, twenty times a second. An exception of either, or a progress that returns
/// False, cancels the work and is thrown when it has stopped. Returns the stage's warnings.
std::vector<std::string> run_stage(const RunSettings& settings,
                                   const std::function<void(const Context&)>& work);

}  // namespace hexwright::python
