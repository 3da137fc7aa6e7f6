// hexwright check, for grids: balance, pairing, and no coarsening against the grid before.
#include "check_grid.h"

#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/pipeline/option_names.h"

namespace hexwright::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What holds of a grid, and why the rest does not.
struct GridVerdict {
  std::optional<Balance> balance;             ///< the strictest that holds
  std::optional<Issue> unbalanced, unpaired;  ///< of the balance demanded; of blocks
  std::optional<Issue> coarsened;             ///< against the grid before
  std::vector<std::string> failures;
};

const char* balance_text(std::optional<Balance> balance) {
  return balance ? name_of(kBalanceNames, *balance) : "none";
}

/// From the strictest on. Strong balance implies the others; weak balance, which looks across faces
/// alone, does not imply relaxed balance: three levels may meet at a vertex.
constexpr std::array kBalances = {Balance::Strong, Balance::Weak, Balance::Relaxed};

GridVerdict judge_grid(const Grid& grid, const GridCheck& check) {
  GridVerdict verdict;
  for (const Balance balance : kBalances) {
    if (!find_unbalanced(grid, balance)) {
      verdict.balance = balance;
      break;
    }
  }
  if (check.balance)
    verdict.unbalanced = find_unbalanced(grid, *check.balance);
  else if (!verdict.balance)
    verdict.unbalanced = find_unbalanced(grid, Balance::Relaxed);
  verdict.unpaired = find_unpaired(grid);
  if (!check.before.empty()) verdict.coarsened = find_coarsened(grid, read_grid(check.before));

  if (verdict.unbalanced)
    verdict.failures.push_back(verdict.unbalanced->message +
                               "; run 'hexwright complete' on the grid");
  if (check.needs_blocks && verdict.unpaired)
    verdict.failures.push_back(verdict.unpaired->message +
                               "; run 'hexwright complete' with --pairing blocks");
  if (verdict.coarsened)
    verdict.failures.push_back(check.before + ": " + verdict.coarsened->message);
  return verdict;
}

std::string to_json(const Grid& grid, const GridCheck& check, const GridVerdict& verdict) {
  Json json;
  json["valid"] = verdict.failures.empty();
  json["cells"] = grid.num_cells();
  json["cells_per_level"] = count_cells_per_level(grid);
  json["roots"] = grid.roots.size();
  json["balance"] = balance_text(verdict.balance);
  json["pairing"] = verdict.unpaired ? "none" : "blocks";
  if (verdict.unpaired) json["first_unpaired"] = verdict.unpaired->message;
  if (!check.before.empty()) json["refines_input"] = !verdict.coarsened;
  json["failures"] = verdict.failures;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_verdict(const Grid& grid, const GridCheck& check, const GridVerdict& verdict,
                   Console& console) {
  console.print(fmt::format("{}: {} cells, levels to {}, {} root cube(s)", check.input,
                            grid.num_cells(), grid.finest_level, grid.roots.size()));
  console.print(fmt::format("  balance          {}", balance_text(verdict.balance)));
  console.print(fmt::format("  pairing          {}", verdict.unpaired ? "none" : "blocks"));
  if (verdict.unpaired && !check.needs_blocks)
    console.print(fmt::format("                   not by blocks: {}", verdict.unpaired->message));
  if (!check.before.empty() && !verdict.coarsened)
    console.print(fmt::format("  refines          {}", check.before));
}

}  // namespace

/// The report is written before anything is printed, so that a closed pipe loses no result.
void check_grid(const GridCheck& check, Program& program) {
  const Grid grid = read_grid(check.input);  // throws when the cells do not tile the roots
  const GridVerdict verdict = judge_grid(grid, check);
  const std::string json = to_json(grid, check, verdict);
  if (!check.report.empty()) write_file_atomically(check.report, json);
  if (check.as_json)
    std::fwrite(json.data(), 1, json.size(), stdout);
  else
    print_verdict(grid, check, verdict, program.console);
  for (const std::string& f : verdict.failures) program.console.fail(check.input + ": " + f);
  program.exit_code = verdict.failures.empty() ? Valid : FailsGate;
}

}  // namespace hexwright::cli
