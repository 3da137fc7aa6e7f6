// Peak memory of the process.
//
// POSIX leaves the unit of ru_maxrss open: Linux counts KiB, macOS bytes.
#include "hexwright/pipeline/report.h"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#endif

namespace hexwright {

std::size_t peak_memory_bytes() {
#if defined(__unix__) || defined(__APPLE__)
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  const auto peak = static_cast<std::size_t>(usage.ru_maxrss);
#if defined(__APPLE__)
  return peak;  // bytes
#else
  return peak * 1024;  // KiB
#endif
#else
  return 0;
#endif
}

}  // namespace hexwright
