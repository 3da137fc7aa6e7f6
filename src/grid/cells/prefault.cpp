// Lets several threads bring in the pages of a large array, on Linux.
//
// A fresh array of gigabytes has no memory behind it: the kernel finds and clears a page at each
// first touch. That took a fifth of a completion's time, most of it for the bookkeeping of pages of
// 4 KiB, so large pages are asked for, and all of them at once.
#include "grid/cells/prefault.h"

#include <cstdint>

#include "hexwright/base/parallel.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace hexwright::grids {

#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
void prefault_pages(void* begin, std::size_t num_bytes) {
  // Multiples of a large page; the ragged ends are left to ordinary faults.
  constexpr std::uintptr_t kAlign = 1 << 21;
  constexpr std::size_t kBlock = 2 * kAlign;
  const std::uintptr_t from =
      (reinterpret_cast<std::uintptr_t>(begin) + kAlign - 1) / kAlign * kAlign;
  const std::uintptr_t to = (reinterpret_cast<std::uintptr_t>(begin) + num_bytes) / kAlign * kAlign;
  if (to < from + 2 * kBlock) return;
  // A kernel without large pages, or too old for the second request, refuses at no cost.
  (void)madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
  parallel_chunks(to - from, kBlock, [&](std::size_t a, std::size_t b) {
    (void)madvise(reinterpret_cast<void*>(from + a), b - a, MADV_POPULATE_WRITE);
  });
}
#else
void prefault_pages(void*, std::size_t) {}
#endif

}  // namespace hexwright::grids
