// Terminal output of the program.
#include "console.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

namespace hexwright::cli {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void on_interrupt(int) {
  if (interrupted.exchange(true)) _exit(130);
}

bool is_terminal() {
  static const bool kIsTerminal = isatty(STDERR_FILENO) != 0;
  return kIsTerminal;
}

}  // namespace

/// Stages look at the flag at their next check and end with Error{Cancelled}; nothing is written
/// then.
void install_interrupt_handler() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

/// Progress only on a terminal: logs would fill with carriage returns. The number of threads holds
/// while the console lives.
Context Console::start(std::string about) {
  limit_ = std::make_unique<ThreadLimit>(num_threads);
  Context context;
  context.cancel = &interrupted;
  context.on_warning = [this, about = std::move(about)](std::string_view message) {
    warn(about.empty() ? std::string(message) : fmt::format("{}: {}", about, message));
  };
  if (!is_quiet && is_terminal())
    context.on_progress = [this](std::string_view stage, double fraction) {
      show_progress(stage, fraction);
    };
  return context;
}

void Console::show_progress(std::string_view stage, double fraction) {
  constexpr int kWidth = 30;
  const int done = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::string line = fmt::format("{:<12} [{}{}] {:3.0f}%", stage, std::string(done, '#'),
                                 std::string(kWidth - done, '.'), 100 * fraction);
  if (line == shown_) return;
  shown_ = std::move(line);
  fmt::print(stderr, "\r\033[K{}", shown_);
  std::fflush(stderr);
}

void Console::clear_progress() {
  if (shown_.empty()) return;
  fmt::print(stderr, "\r\033[K");
  shown_.clear();
}

void Console::print(std::string_view line) { print_block(fmt::format("{}\n", line)); }

void Console::print_block(std::string_view text) {
  if (is_quiet) return;
  clear_progress();
  fmt::print("{}", text);
  std::fflush(stdout);  // progress lines of a long run are read as they come
}

/// Warnings and errors go to stderr even when quiet; stdout is for results.
void Console::warn(std::string_view message) {
  clear_progress();
  fmt::print(stderr, "warning: {}\n", message);
}

void Console::fail(std::string_view message) {
  clear_progress();
  fmt::print(stderr, "error: {}\n", message);
}

}  // namespace hexwright::cli
