#include "dual/check_grid.h"

#include <sstream>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

namespace hexwright::test {
namespace {

SplitTree without(const SplitTree& tree, int depth, const LatticeCoord& node) {
  SplitTree out(tree.roots());
  for (int d = 0; d < tree.num_depths(); ++d)
    for (const LatticeCoord& n : tree.split_at(d)) {
      const int shift = d - depth;
      const bool is_below =
          shift >= 0 && node == LatticeCoord{n[0] >> shift, n[1] >> shift, n[2] >> shift};
      if (!is_below) out.split(d, n);
    }
  return out;
}

std::string as_code(const SplitTree& tree) {
  std::ostringstream text;
  const auto print = [&](const LatticeCoord& p) {
    text << '{' << p[0] << ',' << p[1] << ',' << p[2] << '}';
  };
  text << "roots {";
  for (const LatticeCoord& r : tree.roots()) {
    print(r);
    text << ',';
  }
  text << "} splits {";
  for (int d = 0; d < tree.num_depths(); ++d)
    for (const LatticeCoord& n : tree.split_at(d)) {
      text << '{' << d << ',';
      print(n);
      text << "},";
    }
  text << '}';
  return text.str();
}

}  // namespace

bool has_chiral_corner(const std::vector<LatticeCoord>& roots) {
  const std::set<LatticeCoord> set(roots.begin(), roots.end());
  for (const LatticeCoord& r : roots)
    for (int q = 0; q < 8; ++q) {
      int degree[8] = {}, count = 0, num_ends = 0;
      const auto has = [&](int o) {
        return set.count({r[0] + (q & 1) - 1 + (o & 1), r[1] + (q >> 1 & 1) - 1 + (o >> 1 & 1),
                          r[2] + (q >> 2) - 1 + (o >> 2)}) > 0;
      };
      for (int o = 0; o < 8; ++o) {
        if (!has(o)) continue;
        ++count;
        for (int a = 0; a < 3; ++a) degree[o] += has(o ^ 1 << a);
        num_ends += degree[o] == 1;
      }
      if (count == 4 && num_ends == 2 &&
          degree[0] + degree[1] + degree[2] + degree[3] + degree[4] + degree[5] + degree[6] +
                  degree[7] ==
              6)
        return true;
    }
  return false;
}

std::string find_dual_problem(const SplitTree& tree, DualMode mode) {
  const Grid grid = tree.grid();
  DualResult result;
  try {
    result = build_dual(grid, {mode, false, true}, {});
  } catch (const Error& e) {  // domains pinched along an edge
    return e.code() == ErrorCode::BadGeometry && !tree.is_box() ? "" : e.what();
  }
  const bool is_chamfered = has_chiral_corner(grid.roots) || result.report.num_freed_verts > 0;
  if (tree.is_box() && result.report.num_freed_verts > 0) return "a box is chamfered";
  if (auto problem = find_mesh_problem(result.mesh, grid, !is_chamfered); !problem.empty())
    return problem;
  if (result.report.min_scaled_jacobian <= 0) return "inverted element";
  if (mode == DualMode::Blocks && tree.is_box() && result.report.num_inverted_raw > 0)
    return "inverted element before optimisation";
  return "";
}

std::string minimize_failure(const SplitTree& tree, DualMode mode) {
  SplitTree smallest = tree;
  const auto kind = find_dual_problem(tree, mode).substr(0, 12);
  for (bool has_shrunk = true; has_shrunk;) {
    has_shrunk = false;
    for (int d = 0; d < smallest.num_depths() && !has_shrunk; ++d)
      for (const LatticeCoord& n : smallest.split_at(d)) {
        SplitTree smaller = without(smallest, d, n);
        if (find_dual_problem(smaller, mode).substr(0, 12) != kind) continue;
        smallest = std::move(smaller);
        has_shrunk = true;
        break;
      }
  }
  return as_code(smallest);
}

void check_random_grids(const GridFamily& family, unsigned first, unsigned last) {
  for (unsigned seed = first; seed < last; ++seed) {
    const SplitTree tree = family.make_tree(seed, family.make_domain(seed));
    const std::string problem = find_dual_problem(tree, family.mode);
    if (!problem.empty())
      ADD_FAILURE() << "seed " << seed << ": " << problem << "\n"
                    << minimize_failure(tree, family.mode);
  }
}

}  // namespace hexwright::test
