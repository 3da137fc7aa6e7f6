// The one exception type of the library, for the caller's faults and bad files.
//
// Legitimate outcomes (a gap left, a surface not reached, cancelled) are values in result structs,
// never exceptions.
#pragma once

#include <stdexcept>
#include <string>

namespace hexwright {

enum class ErrorCode {
  BadArgument,     ///< an option or argument is out of its documented range
  CannotOpen,      ///< a file cannot be opened, read or written
  BadFile,         ///< a file's content breaks its format's rules
  BadGeometry,     ///< the input parses but cannot be meshed (empty, flat, not finite ...)
  OutOfResources,  ///< a budget (cells, memory) would be exceeded
  Cancelled        ///< the caller's Context asked to stop
};

class Error : public std::runtime_error {
 public:
  /// `where` names the file and line or element ("part.obj:12"), empty when there is none.
  /// `message` says what is wrong and what to do about it.
  Error(ErrorCode code, const std::string& message, std::string where = {})
      : std::runtime_error(where.empty() ? message : where + ": " + message),
        code_(code),
        where_(std::move(where)) {}

  ErrorCode code() const { return code_; }
  const std::string& where() const { return where_; }

 private:
  ErrorCode code_;
  std::string where_;
};

}  // namespace hexwright
