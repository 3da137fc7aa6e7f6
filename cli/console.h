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

 private:
  void show_progress(std::string_view stage, double fraction);

  std::unique_ptr<ThreadLimit> limit_;
  std::string shown_;  ///< the progress line on the terminal now
};

/// Makes Ctrl-C (and SIGTERM) cancel the run; a second one ends the program at once.
void install_interrupt_handler();

}  // namespace hexwright::cli
