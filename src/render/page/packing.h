// Arrays of integers as the text of a page: bytes sorted into planes, deflated, base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hexwright {

/// All lowest bytes, then all second ones, ...: `num_bytes` planes. Planes of like bytes deflate
/// better than numbers do.
std::string to_planes(std::span<const std::uint32_t> values, int num_bytes);

/// A difference modulo 2^(8 num_bytes) with its sign in the lowest bit (0, -1, 1, -2 become 0, 1,
/// 2, 3), so that small differences of either sign are small numbers.
std::uint32_t to_zigzag(std::uint32_t difference, int num_bytes);

/// Each value's difference from the one before it, the first's from 0, by to_zigzag.
std::vector<std::uint32_t> to_deltas(std::span<const std::uint32_t> values, int num_bytes);

/// A zlib stream of the bytes, as base64. Throws Error{OutOfResources}.
std::string to_packed_text(const std::string& bytes);

}  // namespace hexwright
