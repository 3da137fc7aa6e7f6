// The flag is the thread's, as the mode of its rounding is: what a caller wants holds for
// everything it calls, and each thread has a caller of its own. parallel_chunks hands it on to
// workers.
#include "hexwright/base/cancel.h"

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

thread_local const std::atomic<bool>* current_flag = nullptr;

}  // namespace

CancelScope::CancelScope(const std::atomic<bool>* flag) noexcept : outer_(current_flag) {
  current_flag = flag;
}

CancelScope::~CancelScope() { current_flag = outer_; }

const std::atomic<bool>* CancelScope::flag() noexcept { return current_flag; }

void check_cancelled() {
  if (current_flag && current_flag->load(std::memory_order_relaxed))
    throw Error(ErrorCode::Cancelled, "cancelled by the caller");
}

}  // namespace hexwright
