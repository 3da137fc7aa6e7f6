// Byte streams of VTK's XML files: raw or base64, with VTK's block headers and zlib compression.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text/byte_reader.h"

namespace hexwright::io {

/// How a file stores its binary data.
struct BlockFormat {
  ByteOrder order = ByteOrder::Little;
  bool has_wide_headers = false;  ///< 64-bit sizes instead of 32-bit ones
  bool is_compressed = false;     ///< zlib
  bool is_base64 = false;
};

/// Decodes the data block at the start of `encoded`, which may go on after it. Throws
/// Error{BadFile} at `where` when it is truncated or damaged. Memory stays within a constant factor
/// of the encoded size, whatever the headers claim.
std::string decode_block(std::string_view encoded, const BlockFormat& format,
                         const std::string& where);

/// The block (header and zlib-compressed parts, little-endian 64-bit sizes) of `data`. The same
/// bytes for any number of threads.
std::string encode_compressed_block(std::string_view data);

}  // namespace hexwright::io
