// Numbers of options: read whole, in any locale, or not at all.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace hexwright {

/// The whole text as a number; absent with signs where none belong, rests behind it, or overflow.
template <class Value>
std::optional<Value> read_whole(std::string_view text) {
  Value value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

/// The same for a finite number.
inline std::optional<double> read_number(std::string_view text) {
  const auto value = read_whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace hexwright
