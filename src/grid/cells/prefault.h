// Lets several threads bring in the pages of a large array before one thread fills it.
#pragma once

#include <cstddef>

namespace hexwright::grids {

/// Asks the system for the pages of allocated memory, in parallel. Contents stay undefined. A hint:
/// does nothing where the system has no such call. Growing an array of a hundred megabytes
/// otherwise takes as long as completing the grid in it, on one thread, for the faults alone.
void prefault_pages(void* begin, std::size_t num_bytes);

}  // namespace hexwright::grids
