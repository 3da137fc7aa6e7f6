// Terminal output of the program.
#include "console.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include "hexwright/io/atomic_file.h"

namespace hexwright::cli {
namespace {

std::atomic<bool> interrupted{false};
std::atomic<bool> has_failed{false};  // and has said so
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

constexpr int kInterruptedCode = 4;  // as for Error{Cancelled}
// For steps that look at the flag seldom. The rest of the second is the system's, which takes a
// tenth of a second and more to take back each gigabyte.
constexpr suseconds_t kMicrosecondsToUnwind = 300'000;

extern "C" void end_now(int) {
  remove_part_file();
  constexpr std::string_view kMessage = "error: cancelled\n";
  if (!has_failed && write(STDERR_FILENO, kMessage.data(), kMessage.size()) < 0)
    _exit(kInterruptedCode);
  _exit(kInterruptedCode);
}

extern "C" void on_interrupt(int number) {
  if (interrupted.exchange(true)) end_now(number);
  const itimerval once = {{0, 0}, {0, kMicrosecondsToUnwind}};
  setitimer(ITIMER_REAL, &once, nullptr);
}

/// Messages that cannot be delivered never end a run; C streams, unlike fmt::print, do not throw.
void send(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
}

bool is_terminal() {
  static const bool kIsTerminal = isatty(STDERR_FILENO) != 0;
  return kIsTerminal;
}

}  // namespace

const std::atomic<bool>* interrupt_flag() { return &interrupted; }

/// Stages look at the flag at their next check and end with Error{Cancelled}; nothing is written
/// then.
void install_signal_handlers() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGALRM, end_now);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Opened for reading: writes fail, so that lost results are noticed.
void hold_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0) return;
}

std::string to_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\n')
      line += "\\n";
    else if (c == '\t')
      line += "\\t";
    else if (code < 0x20 || code == 0x7f)
      line += fmt::format("\\x{:02x}", code);
    else
      line += c;
  }
  return line;
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
  send(stderr, fmt::format("\r\033[K{}", shown_));
  std::fflush(stderr);
}

void Console::clear_progress() {
  if (shown_.empty()) return;
  send(stderr, "\r\033[K");
  shown_.clear();
}

void Console::print(std::string_view line) { print_block(fmt::format("{}\n", line)); }

void Console::print_block(std::string_view text) {
  if (is_quiet) return;
  clear_progress();
  send(stdout, text);
  std::fflush(stdout);  // progress lines of a long run are read as they come
}

/// Warnings and errors go to stderr even when quiet; stdout is for results.
void Console::warn(std::string_view message) {
  clear_progress();
  send(stderr, fmt::format("warning: {}\n", to_one_line(message)));
}

void Console::fail(std::string_view message) {
  clear_progress();
  has_failed = true;
  send(stderr, fmt::format("error: {}\n", to_one_line(message)));
}

bool Console::finish_output() {
  const bool is_flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  if (is_flushed && std::ferror(stdout) == 0) return true;
  fail(is_flushed ? "standard output could not be written"
                  : fmt::format("standard output could not be written: {}", std::strerror(reason)));
  return false;
}

}  // namespace hexwright::cli
