// The one rule by which options mean several names at once: patches of layers, patches and curves
// of sizes, faces of CAD files.
#pragma once

#include <string>

namespace hexwright {

/// Whether a name is meant. A pattern is a glob (`*` and `?`), or else a regular expression
/// (ECMAScript); either is to match the whole name. Errors: BadArgument for a bad one.
bool matches_pattern(const std::string& pattern, const std::string& name);

/// Throws Error{BadArgument} for a pattern that is neither, before the work begins.
void check_pattern(const std::string& pattern);

}  // namespace hexwright
