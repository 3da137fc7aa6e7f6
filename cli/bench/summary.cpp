// Based on: Pitzalis et al. 2021, section 6.1, Table 1 and the text about it, Figure 13.
#include "bench/summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hexwright/pipeline/evaluate.h"

namespace hexwright::cli {
namespace {

/// What the paper reports over 202 models. Growth in thousands of cells; 0 = not reported.
struct PaperRow {
  const char* key;
  double growth_avg, growth_max, relative_avg, relative_max, factor_avg, factor_max;
  double doubled, tripled, quadrupled;
};
constexpr PaperRow kPaper[] = {
    {"octree_strong", 24'400, 213'400, 2.31, 8.02, 3.3, 9.0, .88, .58, .26},
    {"octree_weak", 19'900, 176'200, 1.86, 5.89, 2.9, 6.9, .86, .43, .01},
    {"blocks", 13'600, 151'500, 1.16, 4.51, 2.1, 5.5, .63, .06, .005},
};
constexpr double kPaperInputAvg = 12'000, kPaperInputMax = 128'000;
constexpr double kPaperCellsPerSecond = 710;

Json paper_figures() {
  Json paper = {{"models", 202},
                {"input", {{"avg", kPaperInputAvg}, {"max", kPaperInputMax}}},
                {"cells_per_second", kPaperCellsPerSecond}};
  for (const PaperRow& row : kPaper)
    paper["methods"][row.key] = {
        {"growth", {{"avg", row.growth_avg}, {"max", row.growth_max}}},
        {"relative_growth", {{"avg", row.relative_avg}, {"max", row.relative_max}}},
        {"factor", {{"avg", row.factor_avg}, {"max", row.factor_max}}},
        {"at_least", {{"2", row.doubled}, {"3", row.tripled}, {"4", row.quadrupled}}}};
  return paper;
}

Json avg_and_max(const std::vector<double>& values) {
  double sum = 0, largest = 0;
  for (const double v : values) {
    sum += v;
    largest = std::max(largest, v);
  }
  return {{"avg", values.empty() ? 0 : sum / static_cast<double>(values.size())}, {"max", largest}};
}

bool has_all_methods(const Json& record) {
  if (!record.contains("methods")) return false;
  for (const Method& method : evaluated_methods())
    if (!record["methods"].contains(method.key) || !record["methods"][method.key].contains("cells"))
      return false;
  return true;
}

double share_of(const std::vector<double>& values, double at_least) {
  if (values.empty()) return 0;
  const auto n =
      std::count_if(values.begin(), values.end(), [&](double v) { return v >= at_least; });
  return static_cast<double>(n) / static_cast<double>(values.size());
}

/// Median input cells per second, and the fitted seconds = factor cells^exponent.
Json describe_speed(const std::vector<double>& cells, const std::vector<double>& seconds) {
  std::vector<double> speed;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (seconds[i] > 0) speed.push_back(cells[i] / seconds[i]);
  const PowerLaw law = fit_power_law(cells, seconds);
  return {{"cells_per_second", median(speed)}, {"exponent", law.exponent}, {"factor", law.factor}};
}

Json summarize_method(const std::vector<const Json*>& records, const char* key) {
  std::vector<double> input, growth, relative, factor, hexes, hexes_per_blocks, alone, with_dual;
  for (const Json* record : records) {
    const Json& method = (*record)["methods"][key];
    const Json& blocks = (*record)["methods"]["blocks"];
    input.push_back((*record)["input"]["cells"].get<double>());
    growth.push_back(method["growth"].get<double>());
    relative.push_back(method["relative_growth"].get<double>());
    factor.push_back(relative.back() + 1);
    alone.push_back(method["seconds"].get<double>());
    with_dual.push_back(alone.back() + method.value("dual_seconds", 0.0));
    if (!method.contains("hexes") || !blocks.contains("hexes")) continue;
    hexes.push_back(method["hexes"].get<double>());
    hexes_per_blocks.push_back(hexes.back() / blocks["hexes"].get<double>());
  }
  return {
      {"growth", avg_and_max(growth)},
      {"relative_growth", avg_and_max(relative)},
      {"factor", avg_and_max(factor)},
      {"at_least",
       {{"2", share_of(factor, 2)}, {"3", share_of(factor, 3)}, {"4", share_of(factor, 4)}}},
      {"hexes", avg_and_max(hexes)},
      {"hexes_per_blocks", avg_and_max(hexes_per_blocks)},
      {"time",
       {{"alone", describe_speed(input, alone)}, {"with_dual", describe_speed(input, with_dual)}}}};
}

/// Models whose octree and block pairings have equally many cells (Figure 11); sheets need none.
Json find_agreements(const std::vector<const Json*>& records) {
  Json names = Json::array();
  for (const Json* record : records) {
    const Json& methods = (*record)["methods"];
    if (methods["octree_strong"]["cells"] == methods["blocks"]["cells"] &&
        methods["octree_weak"]["cells"] == methods["blocks"]["cells"])
      names.push_back((*record)["model"]);
  }
  return names;
}

Json summarize_meshes(const std::vector<Json>& records) {
  std::vector<double> min_sj, avg_sj, distance, seconds;
  std::size_t made = 0, valid = 0, inverted = 0;
  for (const Json& record : records) {
    if (!record.contains("mesh") || !record["mesh"].contains("verdict")) continue;
    const Json& mesh = record["mesh"];
    const Json& quality = mesh["verdict"]["quality"];
    ++made;
    valid += mesh["valid"].get<bool>() ? 1 : 0;
    inverted += quality["inverted"].get<std::size_t>();
    min_sj.push_back(quality["min_scaled_jacobian"].get<double>());
    avg_sj.push_back(quality["avg_scaled_jacobian"].get<double>());
    seconds.push_back(mesh["seconds"].get<double>());
    if (mesh["verdict"].contains("distance") && mesh["verdict"]["distance"]["max"].is_number())
      distance.push_back(mesh["verdict"]["distance"]["max"].get<double>());
  }
  const double least = min_sj.empty() ? 0 : *std::min_element(min_sj.begin(), min_sj.end());
  return {{"made", made},
          {"valid", valid},
          {"inverted", inverted},
          {"min_sj", {{"least", least}, {"median", median(min_sj)}}},
          {"avg_sj", avg_and_max(avg_sj)},
          {"distance", {{"median", median(distance)}, {"max", avg_and_max(distance)["max"]}}},
          {"seconds", avg_and_max(seconds)}};
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

PowerLaw fit_power_law(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0) || !(y[i] > 0)) continue;
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1;
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 2 || spread <= 1e-12 * n * sxx) return {};
  const double exponent = (n * sxy - sx * sy) / spread;
  return {exponent, std::exp((sy - exponent * sx) / n)};
}

Json summarize(const std::vector<Json>& records) {
  std::vector<const Json*> complete;
  for (const Json& record : records)
    if (has_all_methods(record)) complete.push_back(&record);
  std::vector<double> input;
  for (const Json* record : complete) input.push_back((*record)["input"]["cells"].get<double>());
  Json summary = {{"models", records.size()},
                  {"compared", complete.size()},
                  {"input", avg_and_max(input)},
                  {"methods", Json::object()}};
  for (const Method& method : evaluated_methods()) {
    summary["methods"][method.key] = summarize_method(complete, method.key);
    summary["methods"][method.key]["title"] = method.title;
  }
  summary["agree"] = find_agreements(complete);
  summary["meshes"] = summarize_meshes(records);
  summary["paper"] = paper_figures();
  return summary;
}

std::string summary_to_text(const Json& summary) {
  std::string text = fmt::format(
      "{} models, {} with every method; input grids {:.0f} cells in the mean, {:.0f} at most\n"
      "{:<16}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>14}{:>10}\n",
      summary["models"].get<std::size_t>(), summary["compared"].get<std::size_t>(),
      summary["input"]["avg"].get<double>(), summary["input"]["max"].get<double>(), "method",
      "factor", "paper", "max", ">= 2x", ">= 3x", ">= 4x", "hexes/blocks", "cells/s");
  for (const auto& [key, m] : summary["methods"].items()) {
    const Json& paper = summary["paper"]["methods"];
    const std::string reported =
        paper.contains(key) ? fmt::format("{:.2f}", paper[key]["factor"]["avg"].get<double>())
                            : "-";
    const auto share = [&m = m](const char* factor) {
      return fmt::format("{:.0f}%", 100 * m["at_least"][factor].get<double>());
    };
    text += fmt::format("{:<16}{:>8.2f}{:>8}{:>8.2f}{:>8}{:>8}{:>8}{:>14.2f}{:>10.0f}\n",
                        m["title"].get<std::string>(), m["factor"]["avg"].get<double>(), reported,
                        m["factor"]["max"].get<double>(), share("2"), share("3"), share("4"),
                        m["hexes_per_blocks"]["avg"].get<double>(),
                        m["time"]["with_dual"]["cells_per_second"].get<double>());
  }
  const Json& meshes = summary["meshes"];
  return text + fmt::format("{} meshes, {} valid, {} inverted hexes", meshes["made"].dump(),
                            meshes["valid"].dump(), meshes["inverted"].dump());
}

}  // namespace hexwright::cli
