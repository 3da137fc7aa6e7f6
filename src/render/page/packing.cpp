#include "render/page/packing.h"

#include <zlib.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/io/base64.h"

namespace hexwright {

std::string to_planes(std::span<const std::uint32_t> values, int num_bytes) {
  std::string planes;
  planes.reserve(values.size() * static_cast<std::size_t>(num_bytes));
  for (int byte = 0; byte < num_bytes; ++byte)
    for (const std::uint32_t value : values)
      planes += static_cast<char>(value >> (8 * byte) & 0xff);
  return planes;
}

std::uint32_t to_zigzag(std::uint32_t difference, int num_bytes) {
  const int num_bits = 8 * num_bytes;
  const std::uint32_t mask = num_bits == 32 ? 0xffffffffU : (1U << num_bits) - 1;
  const bool is_negative = (difference >> (num_bits - 1) & 1) != 0;
  return (difference << 1 ^ (is_negative ? mask : 0U)) & mask;
}

std::vector<std::uint32_t> to_deltas(std::span<const std::uint32_t> values, int num_bytes) {
  std::vector<std::uint32_t> deltas(values.size());
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    deltas[i] = to_zigzag(values[i] - last, num_bytes);
    last = values[i];
  }
  return deltas;
}

std::string to_packed_text(const std::string& bytes) {
  check_cancelled();
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  // Level 6: level 9 takes three times as long on connectivity and saves one percent.
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (status != Z_OK) throw Error(ErrorCode::OutOfResources, "a page could not be compressed");
  packed.resize(size);
  return to_base64(packed);
}

}  // namespace hexwright
