// Tokens and numbers of text files.
//
// No copies and no locale: tokens are views into the text, numbers go through std::from_chars.
#include "io/text/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "io/text/file_bytes.h"

namespace hexwright::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
bool ends_token(char c) { return is_blank(c) || c == '\n'; }

// std::from_chars leaves the value alone when it is out of range: tell too small from too large.
bool is_tiny(std::string_view token) {
  if (const auto e = token.find_first_of("eE"); e != std::string_view::npos)
    return e + 1 < token.size() && token[e + 1] == '-';
  return token.find('.') < 3;
}

/// std::from_chars knows no plus sign. "+-1" keeps its own, which makes it no number.
std::string_view without_plus(std::string_view token) {
  const bool has_plus = token.size() >= 2 && token[0] == '+' && token[1] != '-';
  return token.substr(has_plus ? 1 : 0);
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file_name)
    : begin_(text.data()),
      at_(text.data()),
      end_(text.data() + text.size()),
      file_name_(std::move(file_name)) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;  // byte order mark of UTF-8
}

/// Blanks, comments and continued lines (a backslash before the line end, as OBJ has them). True
/// when a token follows on this line.
bool TextScanner::skip_in_line() {
  check_cancelled_();
  while (at_ < end_) {
    if (is_blank(*at_)) {
      ++at_;
    } else if (*at_ == '#') {
      const void* stop = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
      at_ = stop ? static_cast<const char*>(stop) : end_;
    } else if (*at_ == '\\' && end_ - at_ >= 2 && at_[1] == '\n') {
      at_ += 2;
      ++line_;
    } else if (*at_ == '\\' && end_ - at_ >= 3 && at_[1] == '\r' && at_[2] == '\n') {
      at_ += 3;
      ++line_;
    } else {
      return *at_ != '\n';
    }
  }
  return false;
}

char TextScanner::peek_char_in_line() {
  while (at_ < end_ && is_blank(*at_)) ++at_;
  return at_ < end_ ? *at_ : '\n';
}

std::string_view TextScanner::line_token() {
  if (!skip_in_line()) return {};
  const char* first = at_;
  while (at_ < end_ && !ends_token(*at_)) ++at_;
  return {first, static_cast<std::size_t>(at_ - first)};
}

/// Titles and marks are taken as they stand: '#' begins no comment here.
std::string_view TextScanner::rest_of_line() {
  check_cancelled_();
  const char* first = at_;
  const void* stop =
      at_ < end_ ? std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)) : nullptr;
  const char* last = stop ? static_cast<const char*>(stop) : end_;
  at_ = last;
  if (stop) {
    ++at_;
    ++line_;
  }
  if (last > first && last[-1] == '\r') --last;
  return {first, static_cast<std::size_t>(last - first)};
}

/// Raw bytes from here, for the binary parts of formats with text headers. Lines are not counted in
/// them.
std::string_view TextScanner::take(std::size_t num_bytes) {
  const std::string_view result(at_, std::min(num_bytes, bytes_left()));
  at_ += result.size();
  return result;
}

/// True when any token follows, on this line or a later one.
bool TextScanner::skip_blank() {
  while (!skip_in_line()) {
    if (at_ == end_) return false;
    ++at_;  // a line end
    ++line_;
  }
  return true;
}

std::string_view TextScanner::token() {
  skip_blank();
  return line_token();
}

std::string_view TextScanner::peek_token() {
  skip_blank();
  const char* here = at_;
  const std::string_view result = line_token();
  at_ = here;
  return result;
}

/// Locale-free and exact to the last bit. Too small to be told from zero is zero; too large is an
/// error, as is anything after the number.
double TextScanner::to_real(std::string_view token, const char* what) const {
  const std::string_view digits = without_plus(token);
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range && is_tiny(digits)) return 0;
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size())
    fail(std::string("expected a number for ") + what + ", found " + in_quotes(token) +
         "; correct this line or export the file again");
  if (error != std::errc() || !std::isfinite(value))
    fail(std::string(what) + " is not finite (" + in_quotes(token) +
         "); remove the element or give it a finite value");
  return value;
}

std::int64_t TextScanner::to_integer(std::string_view token, const char* what) const {
  const std::string_view digits = without_plus(token);
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size())
    fail(std::string("expected an integer for ") + what + ", found " + in_quotes(token) +
         "; correct this line or export the file again");
  return value;
}

double TextScanner::real(const char* what) {
  const auto t = token();
  if (t.empty()) fail_at_end(what);
  return to_real(t, what);
}

std::int64_t TextScanner::integer(const char* what) {
  const auto t = token();
  if (t.empty()) fail_at_end(what);
  return to_integer(t, what);
}

std::size_t TextScanner::count(const char* what) {
  const std::int64_t value = integer(what);
  if (value < 0) fail(std::string(what) + " is negative; the file is damaged, export it again");
  return static_cast<std::size_t>(value);
}

std::size_t TextScanner::count_of(const char* what, std::size_t bytes_each) {
  const std::size_t value = count(what);
  if (value > bytes_left() / bytes_each + 1 || value > kMaxElements)
    fail(std::to_string(value) + " is more than the file holds for " + what +
         "; it is truncated or damaged, export it again");
  return value;
}

/// All three on one line: a missing coordinate must not be made up from the next vertex.
Vec3 TextScanner::line_point(const char* what) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto t = line_token();
    if (t.empty()) {
      if (is_at_end()) fail_at_end(what);
      fail(std::string("expected three numbers for ") + what +
           " on this line; correct it or export the file again");
    }
    p[axis] = to_real(t, what);
  }
  return p;
}

void TextScanner::fail(const std::string& message) const {
  throw Error(ErrorCode::BadFile, message, where());
}

void TextScanner::fail_at_end(const char* what) const {
  fail(std::string("the file ends where ") + what +
       " should follow: it is truncated; export or download it again");
}

void TextScanner::fail_at(const std::string& file, std::size_t line, const std::string& message) {
  throw Error(ErrorCode::BadFile, message, file + ":" + std::to_string(line));
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a[i]) != lower(b[i])) return false;
  return true;
}

/// What a file holds may be anything: only printable characters reach a message, and few of them.
std::string in_quotes(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (char c : token.substr(0, kLongest)) text += c >= 32 && c < 127 ? c : '?';
  return text + (token.size() > kLongest ? "...'" : "'");
}

}  // namespace hexwright::io
