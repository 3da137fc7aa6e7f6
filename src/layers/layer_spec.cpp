// Reads and completes what is asked of layers. Every refusal names the keys at fault.
#include "hexwright/layers/layer_spec.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/length_unit.h"
#include "hexwright/base/name_pattern.h"

#include "base/read_number.h"

namespace hexwright {
namespace {

constexpr double kAgreement = 0.01;  // of a fourth value with what the three others make it

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadArgument, message);
}

/// Heights of `count` layers over that of the first.
double sum_of_powers(double growth, int count) {
  double sum = 0, height = 1;
  for (int k = 0; k < count; ++k, height *= growth) sum += height;
  return sum;
}

double read_positive(std::string_view text, const std::string& key) {
  const auto value = read_number(text);
  if (!value || !(*value > 0)) refuse(fmt::format("'{}' of {} is no positive number", text, key));
  return *value;
}

LayerLength read_length(std::string_view text, const std::string& key) {
  if (text.ends_with('%'))
    return {read_positive(text.substr(0, text.size() - 1), key) / 100, LayerLength::Unit::Diagonal};
  if (text.ends_with('h'))
    return {read_positive(text.substr(0, text.size() - 1), key), LayerLength::Unit::Edge};
  if (const double metres = take_unit(text); metres > 0)
    return {read_positive(text, key) * metres, LayerLength::Unit::Metre};
  return {read_positive(text, key), LayerLength::Unit::World};
}

double read_growth(std::string_view text) {
  const double growth = read_positive(text, "growth");
  if (growth < 1 || growth > kMaxLayerGrowth)
    refuse(fmt::format("growth:{} is not from 1 to {}", text, kMaxLayerGrowth));
  return growth;
}

int read_count(std::string_view text) {
  const double count = read_positive(text, "count");
  if (count != std::floor(count) || count > kMaxLayers)
    refuse(fmt::format("count:{} is no whole number from 1 to {}", text, kMaxLayers));
  return static_cast<int>(count);
}

/// What was given; absent where nothing was.
struct Given {
  std::optional<LayerLength> first, total;
  std::optional<double> growth;
  std::optional<int> count;

  int size() const {
    return first.has_value() + total.has_value() + growth.has_value() + count.has_value();
  }
};

template <class Value>
void put(std::optional<Value>& slot, const Value& value, std::string_view key) {
  if (slot) refuse(fmt::format("{} is given twice", key));
  slot = value;
}

void read_item(std::string_view item, Given& given) {
  const auto colon = item.find(':');
  const std::string_view key = item.substr(0, colon);
  const std::string_view value =
      colon == std::string_view::npos ? std::string_view() : item.substr(colon + 1);
  if (key == "first")
    put(given.first, read_length(value, "first"), key);
  else if (key == "total")
    put(given.total, read_length(value, "total"), key);
  else if (key == "growth")
    put(given.growth, read_growth(value), key);
  else if (key == "count")
    put(given.count, read_count(value), key);
  else
    refuse(fmt::format("'{}' is none of first:H, growth:R, count:N and total:H", item));
}

Given read_items(std::string_view text) {
  Given given;
  while (true) {
    const auto comma = text.find(',');
    read_item(text.substr(0, comma), given);
    if (comma == std::string_view::npos) return given;
    text.remove_prefix(comma + 1);
  }
}

void require_three(const Given& given) {
  if (given.size() >= 3) return;
  std::string missing;
  const auto name = [&](bool is_there, const char* key) {
    if (!is_there) missing += (missing.empty() ? "" : ", ") + std::string(key);
  };
  name(given.first.has_value(), "first");
  name(given.growth.has_value(), "growth");
  name(given.count.has_value(), "count");
  name(given.total.has_value(), "total");
  refuse(fmt::format("three of first, growth, count and total are needed; {} {} missing, give {}",
                     missing, given.size() == 2 ? "are" : "all",
                     given.size() == 2 ? "one" : "more"));
}

std::string to_text(const LayerLength& length) {
  switch (length.unit) {
    case LayerLength::Unit::Diagonal:
      return fmt::format("{:.6g}%", 100 * length.value);
    case LayerLength::Unit::Edge:
      return fmt::format("{:.6g}h", length.value);
    case LayerLength::Unit::Metre:
      return fmt::format("{:.6g}m", length.value);
    case LayerLength::Unit::World:
      break;
  }
  return fmt::format("{:.6g}", length.value);
}

/// total / first, once both are in the same unit.
double ratio_of(const Given& given) {
  if (given.first->unit != given.total->unit)
    refuse(fmt::format("first:{} and total:{} are in different units; give both in the same",
                       to_text(*given.first), to_text(*given.total)));
  const double ratio = given.total->value / given.first->value;
  if (ratio < 1)
    refuse(fmt::format("first:{} is higher than total:{}; a layer cannot be higher than all",
                       to_text(*given.first), to_text(*given.total)));
  return ratio;
}

/// By bisection: the sum rises with the growth.
double solve_growth(const Given& given) {
  const double ratio = ratio_of(given);
  const int count = *given.count;
  if (ratio < count * (1 - 1e-9))
    refuse(
        fmt::format("first:{} times count:{} is more than total:{}, so layers would have to "
                    "shrink away from the wall; lower first or count, or raise total",
                    to_text(*given.first), count, to_text(*given.total)));
  if (count == 1 ? ratio > 1 + kAgreement : ratio > sum_of_powers(kMaxLayerGrowth, count))
    refuse(
        fmt::format("first:{} and count:{} reach total:{} only with a growth beyond {}; raise "
                    "first or count, or lower total",
                    to_text(*given.first), count, to_text(*given.total), kMaxLayerGrowth));
  double low = 1, high = kMaxLayerGrowth;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (sum_of_powers(middle, count) < ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The whole number of layers whose total is nearest to the one asked for.
int solve_count(const Given& given) {
  const double ratio = ratio_of(given);
  int best = 1;
  for (int count = 1; count <= kMaxLayers; ++count) {
    const double sum = sum_of_powers(*given.growth, count);
    if (std::abs(sum - ratio) < std::abs(sum_of_powers(*given.growth, best) - ratio)) best = count;
    if (sum > ratio) return best;
  }
  refuse(
      fmt::format("first:{} and growth:{} need more than {} layers for total:{}; raise first or "
                  "growth, or lower total",
                  to_text(*given.first), *given.growth, kMaxLayers, to_text(*given.total)));
}

void require_agreement(const Given& given, const LayerSpec& spec) {
  const double ratio = ratio_of(given);
  const double made = sum_of_powers(spec.growth, spec.count);
  if (std::abs(made / ratio - 1) <= kAgreement) return;
  LayerLength total = *given.first;
  total.value *= made;
  refuse(fmt::format(
      "first:{}, growth:{} and count:{} make a total of {}, which contradicts "
      "total:{}; leave one of the four out",
      to_text(*given.first), spec.growth, spec.count, to_text(total), to_text(*given.total)));
}

LayerSpec complete(const Given& given) {
  LayerSpec spec;
  spec.growth = given.growth ? *given.growth : solve_growth(given);
  spec.count = given.count ? *given.count : solve_count(given);
  if (given.first) {
    spec.first = *given.first;
  } else {
    spec.first = *given.total;
    spec.first.value /= sum_of_powers(spec.growth, spec.count);
  }
  if (given.size() == 4) require_agreement(given, spec);
  return spec;
}

}  // namespace

double LayerSpec::total() const { return first.value * sum_of_powers(growth, count); }

double LayerSpec::share_of(int k) const {
  return sum_of_powers(growth, k) / sum_of_powers(growth, count);
}

LayerSpec parse_layer_spec(const std::string& text) {
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    refuse(fmt::format("'{}' is not of the form PATTERN=first:H,growth:R,count:N", text));
  const Given given = read_items(std::string_view(text).substr(equals + 1));
  require_three(given);
  LayerSpec spec = complete(given);
  spec.pattern = text.substr(0, equals);
  check_pattern(spec.pattern);
  return spec;
}

}  // namespace hexwright
