// Reads tokens and numbers from text, by line or across lines, and knows the line it is at.
//
// Spaces, tabs, '\r' and a backslash at the end of a line separate tokens within a line; '#' starts
// a comment. Errors are Error{BadFile} with `where` = "file:line"; Error{Cancelled} as
// base/cancel.h says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/base/vec3.h"

namespace hexwright::io {

class TextScanner {
 public:
  /// `text` must outlive the scanner; `file_name` is used in messages only.
  TextScanner(std::string_view text, std::string file_name);

  // Position
  std::size_t line() const { return line_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  bool is_at_end() const { return at_ == end_; }

  /// For text cut out of a file: the line it stands on there.
  void set_line(std::size_t line) { line_ = line; }

  // Within a line
  /// The first byte of this line that is not blank, '\n' when there is none.
  char peek_char_in_line();
  /// Next token of this line, empty when there is none left.
  std::string_view line_token();
  /// The rest of this line without its end; moves to the start of the next line.
  std::string_view rest_of_line();
  /// The next bytes as they are, at most all that are left; for binary parts of text files.
  std::string_view take(std::size_t num_bytes);
  /// Moves to the start of the next line.
  void next_line() { rest_of_line(); }

  // Across lines
  /// Skips blanks, comments and line ends; false when the text ends.
  bool skip_blank();
  /// Next token on any line, empty when the text ends.
  std::string_view token();
  /// Next token without consuming it.
  std::string_view peek_token();

  // Numbers. `what` names the thing in messages ("a coordinate"). The token is the next one on any
  // line. A number that is not finite is an error, one too small for a double is zero.
  double real(const char* what);
  std::int64_t integer(const char* what);
  /// An integer >= 0.
  std::size_t count(const char* what);
  /// How many elements follow, of so many bytes each at least. More than the rest of the text holds
  /// is an error: no memory is reserved on the word of a count.
  std::size_t count_of(const char* what, std::size_t bytes_each);
  /// Three reals that must stand on this line.
  Vec3 line_point(const char* what);

  /// The same for tokens the caller has already taken.
  double to_real(std::string_view token, const char* what) const;
  std::int64_t to_integer(std::string_view token, const char* what) const;

  std::string where() const { return file_name_ + ":" + std::to_string(line_); }
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_at_end(const char* what) const;
  [[noreturn]] static void fail_at(const std::string& file, std::size_t line,
                                   const std::string& message);

 private:
  bool skip_in_line();

  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
  CancelCheck check_cancelled_;  // all text formats are read through here
  std::string file_name_;
};

/// True when the two are equal but for the case of ASCII letters.
bool equals_ignoring_case(std::string_view a, std::string_view b);

/// The token in quotes, shortened and with unprintable bytes replaced, for messages.
std::string in_quotes(std::string_view token);

}  // namespace hexwright::io
