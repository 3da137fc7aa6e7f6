// Random grids: every one must give a valid mesh of its domain without inverted elements.
#include <gtest/gtest.h>

#include "dual/check_grid.h"

namespace hexwright::test {
namespace {

TEST(RandomGrid, PairedBoxes) {
  check_random_grids({random_paired_tree, random_box, DualMode::Blocks}, 0, 100);
}
TEST(RandomGrid, BalancedBoxesBySheets) {
  check_random_grids({random_balanced_tree, random_box, DualMode::Sheets}, 0, 100);
}
TEST(RandomGrid, UnbalancedBoxesBySheets) {
  check_random_grids({random_unbalanced_tree, random_box, DualMode::Sheets}, 0, 100);
}
TEST(RandomGrid, PairedDomains) {
  check_random_grids({random_paired_tree, random_domain, DualMode::Blocks}, 0, 100);
}
TEST(RandomGrid, BalancedDomainsBySheets) {
  check_random_grids({random_balanced_tree, random_domain, DualMode::Sheets}, 0, 100);
}

}  // namespace
}  // namespace hexwright::test
