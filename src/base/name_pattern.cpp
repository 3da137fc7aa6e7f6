// Globs by going back to the last '*', regular expressions by the standard library.
#include "hexwright/base/name_pattern.h"

#include <regex>
#include <string_view>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

bool matches_glob(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++p;
      ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool is_regular_expression(const std::string& pattern) {
  return pattern.find_first_of("[](){}|+^$\\") != std::string::npos ||
         pattern.find(".*") != std::string::npos;
}

std::regex make_regex(const std::string& pattern) {
  try {
    return std::regex(pattern, std::regex::ECMAScript);
  } catch (const std::regex_error& error) {
    throw Error(ErrorCode::BadArgument,
                "the pattern '" + pattern + "' is no regular expression: " + error.what());
  }
}

}  // namespace

void check_pattern(const std::string& pattern) {
  if (is_regular_expression(pattern)) make_regex(pattern);
}

bool matches_pattern(const std::string& pattern, const std::string& name) {
  if (matches_glob(pattern, name)) return true;
  return is_regular_expression(pattern) && std::regex_match(name, make_regex(pattern));
}

}  // namespace hexwright
