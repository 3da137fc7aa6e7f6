// Memory that could not be had. std::bad_alloc does not tell its size, so the program's own
// operator new remembers it.
#include "memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

std::atomic<std::size_t> refused_size{0};

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    refused_size = size;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace hexwright::cli {
namespace {

constexpr double kMebibyte = 1 << 20;

double peak_mebibytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // kibibytes
}

/// The limit of the process where there is one, else the machine's memory.
std::string describe_limit() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    return fmt::format("a limit of {:.0f} MiB is set for the process (ulimit -v)",
                       static_cast<double>(limit.rlim_cur) / kMebibyte);
  return fmt::format("the machine has {:.0f} MiB", static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                                                       static_cast<double>(sysconf(_SC_PAGE_SIZE)) /
                                                       kMebibyte);
}

}  // namespace

std::string describe_memory_shortage() {
  const std::size_t refused = refused_size;
  const std::string more =
      refused < (1u << 20)
          ? "more was needed"
          : fmt::format("{:.0f} MiB more were needed", static_cast<double>(refused) / kMebibyte);
  return fmt::format(
      "not enough memory: {} beside the {:.0f} MiB in use so far, and {}; use fewer levels "
      "(--max-level), a smaller budget (--max-cells, --max-hexes) or a surface with fewer "
      "triangles",
      more, peak_mebibytes(), describe_limit());
}

}  // namespace hexwright::cli
