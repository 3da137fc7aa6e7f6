// Numbers in sentences for people.
#pragma once

#include <string>

namespace hexwright {

/// 1234567 as "1,234,567", in any locale.
inline std::string grouped(std::size_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

/// "1 hex", "2,000 hexes".
inline std::string counted(std::size_t count, const char* one, const char* many) {
  return grouped(count) + " " + (count == 1 ? one : many);
}

}  // namespace hexwright
