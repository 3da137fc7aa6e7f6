// Builds output of text and binary parts fast; numbers are written with as many digits as reading
// them back needs. Looks at the caller's flag meanwhile (base/cancel.h).
#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "hexwright/base/cancel.h"
#include "hexwright/base/vec3.h"

#include "io/text/byte_reader.h"

namespace hexwright::io {

class TextWriter {
 public:
  TextWriter& text(std::string_view words) {
    out_ += words;
    return *this;
  }
  template <class Integer>
  TextWriter& integer(Integer value) {
    return number(value);
  }
  TextWriter& real(double value) { return number(value); }
  TextWriter& single(float value) { return number(value); }
  /// Scientific form with this many digits after the point.
  TextWriter& real_rounded(double value, int digits) {
    char buffer[48];
    const auto result =
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, digits);
    out_.append(buffer, result.ptr);
    return *this;
  }
  /// Scientific form with a point, in exactly `width` characters, with as many digits as fit.
  TextWriter& real_in(std::size_t width, double value) {
    char buffer[48];
    std::to_chars_result result{};
    for (int digits = 16; digits >= 1; --digits) {
      result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific,
                             digits);
      if (static_cast<std::size_t>(result.ptr - buffer) <= width) break;
    }
    return padded(width, {buffer, result.ptr});
  }
  /// Right-aligned; wider where the number does not fit.
  template <class Integer>
  TextWriter& integer_in(std::size_t width, Integer value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return padded(width, {buffer, result.ptr});
  }
  TextWriter& point(const Vec3& p) { return real(p.x).text(" ").real(p.y).text(" ").real(p.z); }
  /// Ids, separated by blanks, plus `base`.
  template <class Ids>
  TextWriter& indices(const Ids& ids, int base) {
    bool is_first = true;
    for (auto id : ids) {
      if (!is_first) out_ += ' ';
      is_first = false;
      integer(id.value() + base);
    }
    return *this;
  }
  template <class Number>
  TextWriter& binary(Number value, ByteOrder order) {
    check_cancelled_();
    store(out_, value, order);
    return *this;
  }
  /// Items in lines of `per_line`, each by `put`, with `separator` between those of a line.
  template <class Items, class Put>
  TextWriter& lines(std::size_t per_line, const char* separator, const Items& items, Put&& put) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      put(items[i]);
      const bool is_line_end = (i + 1) % per_line == 0 || i + 1 == items.size();
      text(is_line_end ? "\n" : separator);
    }
    return *this;
  }

  std::string take() { return std::move(out_); }

 private:
  TextWriter& padded(std::size_t width, std::string_view words) {
    check_cancelled_();
    if (words.size() < width) out_.append(width - words.size(), ' ');
    out_ += words;
    return *this;
  }

  template <class Number>
  TextWriter& number(Number value) {
    check_cancelled_();
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    append({buffer, result.ptr});
    return *this;
  }
  /// Not inlined: GCC 12 warns wrongly of overlaps where it knows the number.
  [[gnu::noinline]] void append(std::string_view words) { out_.append(words); }

  std::string out_;
  CancelCheck check_cancelled_;
};

}  // namespace hexwright::io
