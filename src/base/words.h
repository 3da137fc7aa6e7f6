// Numbers and places in sentences for people.
#pragma once

#include <cstdio>
#include <string>

#include "hexwright/base/vec3.h"

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

/// "(0.5, 2, -1.25)": four digits each.
inline std::string place(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", p.x, p.y, p.z);
  return text;
}

}  // namespace hexwright
