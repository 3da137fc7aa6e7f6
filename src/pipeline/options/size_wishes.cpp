// Reads what is asked of sizes, and refuses contradictions.
#include "hexwright/pipeline/size_wishes.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/base/error.h"
#include "hexwright/base/name_pattern.h"
#include "hexwright/io/surface_io.h"

#include "io/text/file_bytes.h"

namespace hexwright {
namespace {

constexpr double kLeastGrowth = 1.05;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadArgument, message);
}

std::optional<double> to_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> split_at(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == text.size()) return parts;
    begin = end + 1;
  }
}

std::vector<double> to_numbers(const std::string& text, std::size_t count,
                               const std::string& form) {
  std::vector<double> numbers;
  for (const std::string& part : split_at(text, ',')) {
    const auto number = to_number(part);
    if (!number) refuse(fmt::format("'{}' is no number; write {}", part, form));
    numbers.push_back(*number);
  }
  if (numbers.size() != count)
    refuse(fmt::format("'{}' has {} numbers instead of {}; write {}", text, numbers.size(), count,
                       form));
  return numbers;
}

/// What stands before the numbers of a rule, and how it is written.
struct Form {
  std::string_view name;
  SizeRule::Where where;
  std::size_t num_numbers;
  const char* example;
};
constexpr Form kForms[] = {
    {"box", SizeRule::Where::Box, 6, "box:X0,Y0,Z0,X1,Y1,Z1=SIZE"},
    {"ball", SizeRule::Where::Ball, 4, "ball:X,Y,Z,R=SIZE"},
    {"cylinder", SizeRule::Where::Cylinder, 7, "cylinder:X0,Y0,Z0,X1,Y1,Z1,R=SIZE"},
    {"patch", SizeRule::Where::Patch, 0, "patch:NAME=SIZE"},
    {"curve", SizeRule::Where::Curve, 0, "curve:NAME=SIZE"},
    {"near", SizeRule::Where::Near, 0, "near:FILE=SIZE,DISTANCE"},
};

const Form& find_form(std::string_view name, const std::string& text) {
  std::string known;
  for (const Form& form : kForms) {
    if (form.name == name) return form;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", form.example);
  }
  refuse(fmt::format("'{}' is no rule for sizes; write one of {}", text, known));
}

void set_place(const Form& form, const std::string& place, SizeRule& rule) {
  if (form.num_numbers == 0) {
    if (place.empty()) refuse(fmt::format("'{}' names nothing; write {}", rule.text, form.example));
    rule.pattern = place;
    return;
  }
  const std::vector<double> n = to_numbers(place, form.num_numbers, form.example);
  rule.a = {n[0], n[1], n[2]};
  if (rule.where != SizeRule::Where::Ball) rule.b = {n[3], n[4], n[5]};
  if (rule.where != SizeRule::Where::Box) rule.radius = n.back();
  if (rule.where == SizeRule::Where::Box)
    for (int a = 0; a < 3; ++a)
      if (rule.a[a] > rule.b[a])
        refuse(fmt::format("the box '{}' ends before it begins; write {}", place, form.example));
  if (rule.where != SizeRule::Where::Box && !(rule.radius > 0))
    refuse(fmt::format("the radius in '{}' must be positive", place));
}

Margin parse_one_margin(const std::string& text) {
  Margin margin;
  margin.is_multiple = text.ends_with('L');
  const auto number = to_number(std::string_view(text).substr(0, text.size() - margin.is_multiple));
  if (!number || *number < 0)
    refuse(
        fmt::format("'{}' is no margin; write a length such as 0.5, or 5L for five times the "
                    "object's longest side",
                    text));
  margin.value = *number;
  return margin;
}

std::string to_text(const Length& length) {
  return length.is_share ? fmt::format("{:.6g}%", 100 * length.value)
                         : fmt::format("{:.6g}", length.value);
}

/// `upper` must not be below the least size.
void check_least(const SizeWishes& wishes, const Length& upper, const std::string& name,
                 double diagonal) {
  if (upper.is_given() && wishes.min_size.in(diagonal) > upper.in(diagonal))
    refuse(fmt::format("--min-size {} forbids the cells that {} asks for; lower --min-size",
                       to_text(wishes.min_size), name));
}

void check_lengths(const SizeWishes& w, double diagonal) {
  if (w.size.is_given() && w.max_size.is_given() && w.max_size.in(diagonal) < w.size.in(diagonal))
    refuse(
        fmt::format("--size {} and --max-size {} contradict: sizes cannot be above the largest; "
                    "give one of them",
                    to_text(w.size), to_text(w.max_size)));
  if (!w.min_size.is_given()) return;
  check_least(w, w.size, "--size " + to_text(w.size), diagonal);
  check_least(w, w.max_size, "--max-size " + to_text(w.max_size), diagonal);
  for (const SizeRule& rule : w.rules) check_least(w, rule.size, "--refine " + rule.text, diagonal);
}

std::string text_of(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  refuse("neither a number nor a text");
}

void set_wish(const std::string& key, const nlohmann::json& value, SizeWishes& wishes) {
  const std::pair<const char*, Length*> lengths[] = {
      {"size", &wishes.size}, {"max-size", &wishes.max_size}, {"min-size", &wishes.min_size}};
  for (const auto& [name, length] : lengths)
    if (key == name) {
      *length = parse_length(text_of(value));
      return;
    }
  if (key == "growth") {
    if (!value.is_number()) refuse("no number");
    wishes.growth = value.get<double>();
  } else if (key == "across" || key == "cells") {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() == 0)
      refuse("no whole number from 1");
    const std::uint64_t most = key == "cells" ? kMostCells : kMostAcross;
    (key == "cells" ? wishes.cells : wishes.across) =
        static_cast<int>(std::min(value.get<std::uint64_t>(), most));
  } else if (key == "refine") {
    if (!value.is_array()) refuse("no list; write [\"box:0,0,0,1,1,1=0.1\", ...]");
    for (const nlohmann::json& rule : value) wishes.rules.push_back(parse_size_rule(text_of(rule)));
  } else if (key == "box") {
    wishes.box = parse_box(text_of(value));
  } else if (key == "margin") {
    wishes.margin = parse_margin(text_of(value));
  } else {
    refuse("unknown; use size, max-size, min-size, growth, across, cells, refine, box or margin");
  }
}

}  // namespace

bool SizeWishes::any() const {
  return size.is_given() || max_size.is_given() || min_size.is_given() || growth > 0 ||
         across > 0 || cells > 0 || !rules.empty();
}

Length parse_length(const std::string& text) {
  Length length;
  length.is_share = text.ends_with('%');
  const auto number = to_number(std::string_view(text).substr(0, text.size() - length.is_share));
  if (!number || !(*number > 0))
    refuse(
        fmt::format("'{}' is no length; write e.g. 2.5 (in the surface's unit) or 1% (of the "
                    "diagonal)",
                    text));
  length.value = length.is_share ? *number / 100 : *number;
  return length;
}

SizeRule parse_size_rule(const std::string& text) {
  const std::size_t colon = text.find(':'), equals = text.rfind('=');
  SizeRule rule;
  rule.text = text;
  const Form& form =
      find_form(std::string_view(text).substr(0, std::min(colon, text.size())), text);
  if (equals == std::string::npos || equals < colon)
    refuse(fmt::format("'{}' has no size; write {}", text, form.example));
  rule.where = form.where;
  const std::vector<std::string> sizes = split_at(std::string_view(text).substr(equals + 1), ',');
  if (sizes.size() > 2)
    refuse(fmt::format("'{}' has more than a size and a distance behind the '='", text));
  rule.size = parse_length(sizes[0]);
  if (sizes.size() == 2) rule.distance = parse_length(sizes[1]);
  set_place(form, text.substr(colon + 1, equals - colon - 1), rule);
  if (rule.where == SizeRule::Where::Near)
    rule.surface = std::make_shared<const TriMesh>(read_surface(rule.pattern).mesh);
  else if (!rule.pattern.empty())
    check_pattern(rule.pattern);
  return rule;
}

Box3 parse_box(const std::string& text) {
  const std::vector<double> n = to_numbers(text, 6, "X0,Y0,Z0,X1,Y1,Z1");
  const Box3 box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  for (int a = 0; a < 3; ++a)
    if (!(box.lo[a] < box.hi[a]))
      refuse(fmt::format("the box '{}' has no room along an axis; write X0,Y0,Z0,X1,Y1,Z1", text));
  return box;
}

std::array<Margin, 6> parse_margin(const std::string& text) {
  std::vector<Margin> given;
  for (const std::string& part : split_at(text, ',')) given.push_back(parse_one_margin(part));
  if (given.size() != 1 && given.size() != 3 && given.size() != 6)
    refuse(fmt::format("'{}' has {} margins; write one, three (x,y,z) or six (-x,+x,-y,+y,-z,+z)",
                       text, given.size()));
  std::array<Margin, 6> margins;
  for (std::size_t side = 0; side < 6; ++side)
    margins[side] = given[given.size() == 6 ? side : given.size() == 3 ? side / 2 : 0];
  return margins;
}

void read_size_wishes(const std::string& path, SizeWishes& wishes) {
  const io::FileBytes file = io::read_file(path);
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(file.bytes);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::BadFile, fmt::format("is no JSON: {}", error.what()), path);
  }
  if (!json.is_object())
    throw Error(ErrorCode::BadFile, "holds no object; write {\"size\": 2, ...}", path);
  for (const auto& [key, value] : json.items()) try {
      set_wish(key, value, wishes);
    } catch (const Error& error) {
      throw Error(ErrorCode::BadFile, fmt::format("\"{}\": {}", key, error.what()), path);
    }
}

void check_size_wishes(const SizeWishes& wishes, Side side, double diagonal) {
  check_lengths(wishes, diagonal);
  if (wishes.cells > 0 && (wishes.size.is_given() || wishes.max_size.is_given()))
    refuse(fmt::format("--cells finds the size itself, so {} cannot be given too; leave one out",
                       wishes.size.is_given() ? "--size" : "--max-size"));
  if (wishes.growth != 0 && !(wishes.growth >= kLeastGrowth))
    refuse(fmt::format("--growth {} is below {}; 1.2 is gentle, 2 what an octree does by itself",
                       wishes.growth, kLeastGrowth));
  if (wishes.box && wishes.margin)
    refuse("--box and --margin both say how large the domain is; give one of them");
  if (wishes.has_domain() && side == Side::Inside)
    refuse(fmt::format("{} is the domain around an object; add --side outside or --side both",
                       wishes.box ? "--box" : "--margin"));
}

}  // namespace hexwright
