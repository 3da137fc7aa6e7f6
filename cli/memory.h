// What the program says when memory runs out.
#pragma once

#include <string>

namespace hexwright::cli {

/// After std::bad_alloc: the size that was asked for last in vain, what was in use at most, what
/// may be used, and what to lower. One sentence.
std::string describe_memory_shortage();

}  // namespace hexwright::cli
