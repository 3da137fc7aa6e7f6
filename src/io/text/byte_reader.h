// Numbers of binary files in either byte order, without alignment demands.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace hexwright::io {

enum class ByteOrder { Little, Big };

inline constexpr ByteOrder kNativeOrder =
    std::endian::native == std::endian::little ? ByteOrder::Little : ByteOrder::Big;

/// The number stored at `at`, which must have sizeof(T) readable bytes.
template <class T>
T load(const char* at, ByteOrder order) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (order != kNativeOrder) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Appends the number's bytes.
template <class T>
void store(std::string& out, T value, ByteOrder order) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != kNativeOrder) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

}  // namespace hexwright::io
