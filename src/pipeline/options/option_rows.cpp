// Reading values of options. Numbers are read whole, in any locale, or refused: signs where none
// belong, rests behind the number and overflow are errors.
#include "pipeline/options/option_rows.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hexwright/base/error.h"

#include "base/read_number.h"

namespace hexwright {
namespace {

constexpr const char* kNone = "none";

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw Error(ErrorCode::BadArgument, fmt::format("'{}' is {}", text, what));
}

bool to_flag(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  refuse(text, "neither true nor false");
}

std::string describe_range(double least, double most) {
  if (!std::isfinite(most)) return fmt::format("{} or more", least);
  return fmt::format("{} to {}", least, most);
}

NamedOption make_row(RowText text, OptionKind kind, std::string allowed, std::string fallback) {
  NamedOption row;
  row.name = std::move(text.name);
  row.help = std::move(text.help);
  row.kind = kind;
  row.allowed = std::move(allowed);
  row.fallback = std::move(fallback);
  return row;
}

}  // namespace

double parse_share(const std::string& text, bool zero_allowed) {
  const bool is_percent = text.ends_with('%');
  const auto number = read_number(std::string_view(text).substr(0, text.size() - is_percent));
  const double value = number.value_or(-1) / (is_percent ? 100 : 1);
  // A share of 1 or more is nearly always a forgotten percent sign.
  const bool is_share = (value > 0 && value < 1) || (zero_allowed && value == 0);
  if (!is_share) refuse(text, "not a share of the diagonal; write e.g. 0.5% or 0.005");
  return value;
}

std::string share_to_text(double share) { return fmt::format("{:.6g}%", 100 * share); }

NamedOption flag_row(RowText text, std::function<void()> enable) {
  NamedOption row = make_row(std::move(text), OptionKind::Flag, "", "false");
  row.set = [enable = std::move(enable)](const std::string& given) {
    if (to_flag(given)) enable();
  };
  return row;
}

NamedOption flag_row(RowText text, bool& value, bool value_when_given) {
  return flag_row(std::move(text), [&value, value_when_given] { value = value_when_given; });
}

NamedOption whole_row(RowText text, int& value, int least, int most) {
  const std::string allowed = describe_range(least, most);
  NamedOption row = make_row(std::move(text), OptionKind::Whole, allowed, fmt::to_string(value));
  row.set = [&value, least, most, allowed](const std::string& given) {
    const auto number = read_whole<int>(given);
    if (!number || *number < least || *number > most)
      refuse(given, "no whole number from " + allowed);
    value = *number;
  };
  return row;
}

NamedOption count_row(RowText text, std::size_t& value, std::size_t least) {
  NamedOption row = make_row(std::move(text), OptionKind::Whole, fmt::format("{} or more", least),
                             fmt::to_string(value));
  row.set = [&value, least](const std::string& given) {
    const auto number = read_whole<std::uint64_t>(given);
    if (!number || *number < least)
      refuse(given, fmt::format("no whole number from {} up to 2^64; write digits only", least));
    value = *number;
  };
  return row;
}

NamedOption number_row(RowText text, double& value, double least, double most) {
  const std::string allowed = describe_range(least, most);
  NamedOption row =
      make_row(std::move(text), OptionKind::Number, allowed, fmt::format("{}", value));
  row.set = [&value, least, most, allowed](const std::string& given) {
    const auto number = read_number(given);
    if (!number || *number < least || *number > most) refuse(given, "no number from " + allowed);
    value = *number;
  };
  return row;
}

NamedOption degrees_row(RowText text, double& radians, double least, double most) {
  const double degrees = radians * 180 / std::numbers::pi;
  const std::string allowed = describe_range(least, most);
  NamedOption row =
      make_row(std::move(text), OptionKind::Degrees, allowed, fmt::format("{:.6g}", degrees));
  row.set = [&radians, least, most, allowed](const std::string& given) {
    const auto number = read_number(given);
    if (!number || *number < least || *number > most)
      refuse(given, "no angle in degrees from " + allowed);
    radians = *number * std::numbers::pi / 180;
  };
  return row;
}

NamedOption share_row(RowText text, double& value) {
  NamedOption row =
      make_row(std::move(text), OptionKind::Share, "above 0, below 100%", share_to_text(value));
  row.set = [&value](const std::string& given) { value = parse_share(given); };
  return row;
}

NamedOption length_row(RowText text, Length& value) {
  NamedOption row = make_row(std::move(text), OptionKind::Length, "above 0", kNone);
  row.set = [&value](const std::string& given) { value = parse_length(given); };
  return row;
}

NamedOption text_row(RowText text, std::string form,
                     std::function<void(const std::string& text)> read) {
  NamedOption row = make_row(std::move(text), OptionKind::Text, std::move(form), kNone);
  row.set = std::move(read);
  return row;
}

NamedOption file_row(RowText text, std::string form,
                     std::function<void(const std::string& path)> read) {
  NamedOption row = text_row(std::move(text), std::move(form), std::move(read));
  row.kind = OptionKind::File;
  return row;
}

NamedOption list_row(RowText text, std::string form,
                     std::function<void(const std::string& text)> read) {
  NamedOption row = make_row(std::move(text), OptionKind::List, std::move(form), kNone);
  row.set = [read = std::move(read)](const std::string& given) {
    std::size_t begin = 0;
    while (true) {
      const std::size_t end = std::min(given.find('\n', begin), given.size());
      read(given.substr(begin, end - begin));
      if (end == given.size()) return;
      begin = end + 1;
    }
  };
  return row;
}

NamedOption choice_row(RowText text, const std::vector<std::string>& names,
                       const std::string& fallback) {
  return make_row(std::move(text), OptionKind::Choice, fmt::format("{}", fmt::join(names, "|")),
                  fallback);
}

std::size_t find_choice(const std::string& text, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == text) return k;
  refuse(text, fmt::format("none of {}", fmt::join(names, "|")));
}

const NamedOption* find_option(const OptionTable& table, std::string_view name) {
  for (const NamedOption& row : table)
    if (row.name == name) return &row;
  return nullptr;
}

}  // namespace hexwright
