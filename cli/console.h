// What the program says, and where: results on standard output, progress and messages on standard
// error.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hexwright/base/context.h"
#include "hexwright/base/parallel.h"

namespace hexwright::cli {

class Console {
 public:
  bool is_quiet = false;  ///< neither progress nor results; warnings and errors remain
  int num_threads = 0;    ///< 0 = one per core

  /// A context whose progress goes to a bar (on a terminal only), whose warnings are printed, and
  /// which an interrupt cancels. Limits the threads as asked while the console lives.
  /// `about` is the file that warnings name.
  Context start(std::string about = {});

  void print(std::string_view line);        ///< a result line, unless quiet
  void print_block(std::string_view text);  ///< lines that end with a line end each
  void warn(std::string_view message);      ///< "warning: ..."
  void fail(std::string_view message);      ///< "error: ..."
  void clear_progress();
  /// Sends the rest of the results; false when some of them could not be written (disk full,
  /// reader gone, stream closed), which has been said then.
  bool finish_output();

 private:
  void show_progress(std::string_view stage, double fraction);

  std::unique_ptr<ThreadLimit> limit_;
  std::string shown_;  ///< the progress line on the terminal now
};

/// Text on one line of a terminal: control characters as \n, \t or \xHH.
std::string to_one_line(std::string_view text);

/// Makes Ctrl-C (and SIGTERM) cancel the run: within a second, and a second one at once, with exit
/// code 4. Signals about full disks and readers that left become errors of the writing call.
void install_signal_handlers();

/// Set by these signals. Loops of the library look at it within a CancelScope.
const std::atomic<bool>* interrupt_flag();

/// Occupies the numbers of closed standard streams, so that no output file gets one of them and
/// is mixed with messages. What is written to such a stream is lost, as asked.
void hold_standard_streams();

}  // namespace hexwright::cli
