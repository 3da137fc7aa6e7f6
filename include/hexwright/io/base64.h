// Bytes as text that any file can carry.
//
// Based on: RFC 4648, section 4.
#pragma once

#include <string>
#include <string_view>

namespace hexwright {

/// With padding, without line breaks.
std::string to_base64(std::string_view bytes);

}  // namespace hexwright
