// Refuses contradictions between what is asked of sizes.
#include "hexwright/pipeline/size_wishes.h"

#include <cmath>

#include <fmt/format.h>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

constexpr double kLeastGrowth = 1.05;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadArgument, message);
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

}  // namespace

bool SizeWishes::any() const {
  return size.is_given() || max_size.is_given() || min_size.is_given() || growth > 0 ||
         across > 0 || cells > 0 || !rules.empty();
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
