// Reads one wish about sizes each.
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/length_unit.h"
#include "hexwright/base/name_pattern.h"
#include "hexwright/io/surface_io.h"
#include "hexwright/pipeline/size_wishes.h"

#include "base/read_number.h"

namespace hexwright {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadArgument, message);
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
    const auto number = read_number(part);
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
  bool is_file = false;  ///< the place is a surface's file
};
constexpr Form kForms[] = {
    {"box", SizeRule::Where::Box, 6, "box:X0,Y0,Z0,X1,Y1,Z1=SIZE"},
    {"ball", SizeRule::Where::Ball, 4, "ball:X,Y,Z,R=SIZE"},
    {"cylinder", SizeRule::Where::Cylinder, 7, "cylinder:X0,Y0,Z0,X1,Y1,Z1,R=SIZE"},
    {"patch", SizeRule::Where::Patch, 0, "patch:NAME=SIZE"},
    {"curve", SizeRule::Where::Curve, 0, "curve:NAME=SIZE"},
    {"region", SizeRule::Where::Region, 0, "region:NAME=SIZE"},
    {"near", SizeRule::Where::Near, 0, "near:FILE=SIZE,DISTANCE", true},
    {"inside", SizeRule::Where::Region, 0, "inside:FILE=SIZE", true},
    {"field", SizeRule::Where::Field, 0, "field:FILE or field:FILE=ARRAY"},
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

void set_sizes(std::string_view text, SizeRule& rule) {
  const std::vector<std::string> sizes = split_at(text, ',');
  if (sizes.size() > 2)
    refuse(fmt::format("'{}' has more than a size and a distance behind the '='", rule.text));
  rule.size = parse_length(sizes[0]);
  if (sizes.size() == 2) rule.distance = parse_length(sizes[1]);
}

Margin parse_one_margin(const std::string& text) {
  Margin margin;
  margin.is_multiple = text.ends_with('L');
  std::string_view digits = std::string_view(text).substr(0, text.size() - margin.is_multiple);
  if (!margin.is_multiple) margin.metres = take_unit(digits);
  const auto number = read_number(digits);
  if (!number || *number < 0)
    refuse(fmt::format(
        "'{}' is no margin; write a length such as 0.5 or 20mm, or 5L for five times the "
        "object's longest side",
        text));
  margin.value = *number;
  return margin;
}

}  // namespace

Length parse_length(const std::string& text) {
  Length length;
  length.is_share = text.ends_with('%');
  std::string_view digits = std::string_view(text).substr(0, text.size() - length.is_share);
  if (!length.is_share) length.metres = take_unit(digits);
  const auto number = read_number(digits);
  if (!number || !(*number > 0))
    refuse(
        fmt::format("'{}' is no length; write e.g. 2.5 (in the surface's unit), 2.5mm or 1% (of "
                    "the diagonal)",
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
  rule.where = form.where;
  const bool has_equals = equals != std::string::npos && equals > colon;
  if (form.where == SizeRule::Where::Field) {
    set_place(form, colon == std::string::npos ? "" : text.substr(colon + 1, equals - colon - 1),
              rule);
    const std::string array = has_equals ? text.substr(equals + 1) : "";
    rule.field = std::make_shared<const PointField>(read_point_field(rule.pattern, array));
    return rule;
  }
  if (!has_equals) refuse(fmt::format("'{}' has no size; write {}", text, form.example));
  set_sizes(std::string_view(text).substr(equals + 1), rule);
  set_place(form, text.substr(colon + 1, equals - colon - 1), rule);
  if (form.is_file)
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

}  // namespace hexwright
