// Lets several threads bring in the pages of a large array, on Linux.
#include "grid/prefault.h"

#include <cstdint>

#include "hexwright/base/parallel.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace hexwright {

#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
void prefault_pages(void* begin, std::size_t num_bytes) {
  // Multiples of any page size in use; the ragged ends are left to ordinary faults.
  constexpr std::uintptr_t kAlign = 1 << 16;
  constexpr std::size_t kBlock = 1 << 22;
  const std::uintptr_t from =
      (reinterpret_cast<std::uintptr_t>(begin) + kAlign - 1) / kAlign * kAlign;
  const std::uintptr_t to = (reinterpret_cast<std::uintptr_t>(begin) + num_bytes) / kAlign * kAlign;
  if (to < from + 2 * kBlock) return;
  parallel_chunks(to - from, kBlock, [&](std::size_t a, std::size_t b) {
    // Older kernels refuse the request, which costs nothing.
    (void)madvise(reinterpret_cast<void*>(from + a), b - a, MADV_POPULATE_WRITE);
  });
}
#else
void prefault_pages(void*, std::size_t) {}
#endif

}  // namespace hexwright
