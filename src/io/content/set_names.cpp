// Numbers of named sets.
#include "io/content/set_names.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "io/surface/polygon_soup.h"

namespace hexwright::io {
namespace {

constexpr std::int64_t kMostNumbers = 1'000'000;

/// The number that a name such as REGION_MINUS_2, PATCH_3 or CURVE_NONE stands for.
std::optional<std::int32_t> number_in(SetKind kind, std::string_view name) {
  const auto underscore = name.rfind('_');
  if (underscore == std::string_view::npos) return std::nullopt;
  std::int32_t number = -1;
  const auto digits = name.substr(underscore + 1);
  if (digits.starts_with('-')) return std::nullopt;
  if (digits != "NONE" &&
      std::from_chars(digits.data(), digits.data() + digits.size(), number).ptr !=
          digits.data() + digits.size())
    return std::nullopt;
  for (const std::int32_t candidate : {number, -number})
    if (default_set_name(kind, candidate) == name) return candidate;
  return std::nullopt;
}

template <class Labeled>
std::int64_t count_numbers(const std::vector<Labeled>& elements) {
  std::int64_t count = 0;
  for (const Labeled& element : elements) {
    if constexpr (requires { element.patch; })
      count = std::max(count, std::int64_t{element.patch.value()} + 1);
    else
      count = std::max(count, std::int64_t{element.curve.value()} + 1);
  }
  return count;
}

}  // namespace

void SetNames::add(SetKind kind, std::int64_t number, std::string_view name) {
  std::string clean = clean_name(name);
  if (number < 0 || number >= kMostNumbers || clean.empty() || number_in(kind, clean)) return;
  names_[{kind, number}] = std::move(clean);
}

void SetNames::apply(VolumeFile& file) const {
  const auto names_of = [&](SetKind kind, std::int64_t num_used) {
    std::vector<std::string> names;
    for (const auto& [key, name] : names_) {
      if (key.first != kind || key.second >= num_used) continue;
      names.resize(static_cast<std::size_t>(std::min(num_used, kMostNumbers)));
      names[static_cast<std::size_t>(key.second)] = name;
    }
    if (num_used > kMostNumbers) names.clear();
    return names;
  };
  std::int64_t num_regions = 1;
  for (std::int32_t region : file.region)
    num_regions = std::max(num_regions, std::int64_t{region} + 1);
  file.region_names = names_of(SetKind::Region, num_regions);
  file.labels.patch_names =
      IdVector<PatchId, std::string>(names_of(SetKind::Patch, count_numbers(file.labels.quads)));
  file.labels.curve_names =
      IdVector<CurveId, std::string>(names_of(SetKind::Curve, count_numbers(file.labels.edges)));
}

std::map<std::int64_t, std::int32_t> number_tags(SetKind kind,
                                                 const std::map<std::int64_t, std::string>& tags,
                                                 SetNames& names) {
  std::map<std::int64_t, std::int32_t> tag_to_number;
  std::set<std::int64_t> taken;
  const bool any_named =
      std::any_of(tags.begin(), tags.end(), [](const auto& tag) { return !tag.second.empty(); });
  const std::int64_t most = any_named ? kMostNumbers : 0x7ffffff0;
  std::int64_t next_free = 0;  // for tags that cannot be numbers
  for (const auto& [tag, name] : tags)
    if (const auto number = number_in(kind, name); number && taken.insert(*number).second)
      tag_to_number[tag] = *number;
  for (const auto& [tag, name] : tags) {
    if (tag_to_number.contains(tag)) continue;
    const bool is_plain_region = kind == SetKind::Region && name.empty();
    std::int64_t number = is_plain_region ? tag : tag - 1;
    const bool is_number = number >= 0 && number < most;
    if (!is_number) number = next_free;
    while (!taken.insert(number).second) ++number;
    if (!is_number) next_free = number + 1;
    tag_to_number[tag] = static_cast<std::int32_t>(number);
    names.add(kind, number, name);
  }
  return tag_to_number;
}

}  // namespace hexwright::io
