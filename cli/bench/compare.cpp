#include "bench/compare.h"

#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace hexwright::cli {
namespace {

using Pointer = Json::json_pointer;

enum class Judged { CountUp, AbsoluteDown, DistanceUp, TimeUp };

struct Figure {
  const char* title;
  const char* path;
  Judged judged;
  double CompareTolerances::*tolerance;
};

constexpr Figure kFigures[] = {
    {"input cells", "/input/cells", Judged::CountUp, &CompareTolerances::count},
    {"octree+strong cells", "/methods/octree_strong/cells", Judged::CountUp,
     &CompareTolerances::count},
    {"octree+weak cells", "/methods/octree_weak/cells", Judged::CountUp, &CompareTolerances::count},
    {"blocks cells", "/methods/blocks/cells", Judged::CountUp, &CompareTolerances::count},
    {"sheets cells", "/methods/sheets/cells", Judged::CountUp, &CompareTolerances::count},
    {"blocks hexes", "/methods/blocks/hexes", Judged::CountUp, &CompareTolerances::count},
    {"sheets hexes", "/methods/sheets/hexes", Judged::CountUp, &CompareTolerances::count},
    {"mesh hexes", "/mesh/hexes", Judged::CountUp, &CompareTolerances::count},
    {"mesh inverted", "/mesh/verdict/quality/inverted", Judged::CountUp, &CompareTolerances::count},
    {"min scaled Jacobian", "/mesh/verdict/quality/min_scaled_jacobian", Judged::AbsoluteDown,
     &CompareTolerances::min_sj},
    {"avg scaled Jacobian", "/mesh/verdict/quality/avg_scaled_jacobian", Judged::AbsoluteDown,
     &CompareTolerances::avg_sj},
    {"distance", "/mesh/verdict/distance/max", Judged::DistanceUp, &CompareTolerances::distance},
    {"features", "/mesh/verdict/features/length_share", Judged::AbsoluteDown,
     &CompareTolerances::features},
    {"blocks seconds", "/methods/blocks/seconds", Judged::TimeUp, &CompareTolerances::time},
    {"mesh seconds", "/mesh/seconds", Judged::TimeUp, &CompareTolerances::time},
};

std::optional<double> find_number(const Json& record, const char* path) {
  const Pointer pointer(path);
  if (!record.contains(pointer) || !record[pointer].is_number()) return std::nullopt;
  return record[pointer].get<double>();
}

/// Figures of the mesh are missed as a whole.
bool is_of_mesh(const Figure& figure) {
  return std::string_view(figure.path).starts_with("/mesh/");
}

/// Whether a single model's figure became worse than allowed. Times are judged in sum only.
bool is_worse(const Figure& figure, double before, double after, const CompareTolerances& t) {
  constexpr double kNegligibleDistance = 1e-4;
  const double tolerance = t.*figure.tolerance;
  switch (figure.judged) {
    case Judged::CountUp:
      return after > before * (1 + tolerance);
    case Judged::AbsoluteDown:
      return after < before - tolerance;
    case Judged::DistanceUp:
      return after > std::max(before * (1 + tolerance), kNegligibleDistance);
    case Judged::TimeUp:
      return false;
  }
  return false;
}

struct Sums {
  double before = 0, after = 0, log_ratios = 0;
  std::size_t num_models = 0, num_ratios = 0, num_better = 0, num_worse = 0;

  void add(double a, double b, bool higher_is_better) {
    before += a;
    after += b;
    ++num_models;
    num_better += (higher_is_better ? b > a : b < a) ? 1 : 0;
    num_worse += (higher_is_better ? b < a : b > a) ? 1 : 0;
    if (!(a > 0) || !(b > 0)) return;
    log_ratios += std::log(b / a);
    ++num_ratios;
  }
};

class Comparer {
 public:
  explicit Comparer(const CompareTolerances& tolerances) : tolerances_(tolerances) {}

  void add(const Json& before, const Json& after) {
    const std::string model = before["model"];
    compare_outcome(model, before, after);
    for (const Figure& figure : kFigures) {
      const auto a = find_number(before, figure.path), b = find_number(after, figure.path);
      if (a && !b && !is_of_mesh(figure))
        result_.regressions.push_back(
            fmt::format("{}: {} is no longer there", model, figure.title));
      if (!a || !b) continue;
      sums_[figure.title].add(*a, *b, figure.judged == Judged::AbsoluteDown);
      if (is_worse(figure, *a, *b, tolerances_))
        result_.regressions.push_back(
            fmt::format("{}: {} went from {:.6g} to {:.6g}", model, figure.title, *a, *b));
    }
  }

  void add_missing(const std::string& model) {
    result_.regressions.push_back(model + ": is missing from the second results");
  }

  Comparison finish() {
    result_.text = fmt::format("{:<22}{:>8}{:>14}{:>14}{:>8}{:>10}{:>8}{:>8}\n", "figure", "models",
                               "sum before", "sum after", "ratio", "geo.mean", "better", "worse");
    for (const Figure& figure : kFigures) add_row(figure);
    return std::move(result_);
  }

 private:
  void compare_outcome(const std::string& model, const Json& before, const Json& after) {
    const std::string was = before.value("status", ""), is = after.value("status", "");
    if (was == "done" && is != "done")
      result_.regressions.push_back(fmt::format("{}: {} instead of done ({})", model, is,
                                                after.value("message", "no message")));
    const Pointer valid("/mesh/valid");
    if (before.contains(valid) && !after.contains(valid))
      result_.regressions.push_back(model + ": there is no mesh any more");
    else if (before.value(valid, false) && !after.value(valid, false))
      result_.regressions.push_back(model + ": the mesh is no longer valid");
  }

  void add_row(const Figure& figure) {
    const Sums& s = sums_[figure.title];
    if (s.num_models == 0) return;
    const std::string ratio = s.before > 0 ? fmt::format("{:.3f}", s.after / s.before) : "-";
    const double mean =
        s.num_ratios == 0 ? 1 : std::exp(s.log_ratios / static_cast<double>(s.num_ratios));
    result_.text +=
        fmt::format("{:<22}{:>8}{:>14.6g}{:>14.6g}{:>8}{:>10.3f}{:>8}{:>8}\n", figure.title,
                    s.num_models, s.before, s.after, ratio, mean, s.num_better, s.num_worse);
    if (figure.judged == Judged::TimeUp && tolerances_.time > 0 &&
        s.after > s.before * (1 + tolerances_.time))
      result_.regressions.push_back(fmt::format("all models: {} went from {:.3g} to {:.3g}",
                                                figure.title, s.before, s.after));
  }

  const CompareTolerances& tolerances_;
  Comparison result_;
  std::map<std::string, Sums> sums_;
};

}  // namespace

Comparison compare_results(const std::vector<Json>& before, const std::vector<Json>& after,
                           const CompareTolerances& tolerances) {
  std::map<std::string, const Json*> by_name;
  for (const Json& record : after) by_name[record["model"]] = &record;
  Comparer comparer(tolerances);
  for (const Json& record : before) {
    const auto it = by_name.find(record["model"]);
    if (it == by_name.end())
      comparer.add_missing(record["model"]);
    else
      comparer.add(record, *it->second);
  }
  return comparer.finish();
}

}  // namespace hexwright::cli
