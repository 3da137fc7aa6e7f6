// Prints the tables of docs/results/dual.md: every .cells grid of a folder in every mode, and what
// the modes come to over all grids.
//
// Usage: dual_table GRID_DIR REFERENCE_CSV. The csv has columns model, gp_weak, gp_weak_hexes (the
// leaves and hexes of the paper's implementation).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "hexwright/dual/dual_mesh.h"
#include "hexwright/grid/complete.h"
#include "hexwright/io/grid_io.h"

namespace hexwright {
namespace {

struct Reference {
  double leaves = 0, hexes = 0;
};

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

std::map<std::string, Reference> read_reference(const char* path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  const auto header = split_line(line);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t leaves = column("gp_weak"), hexes = column("gp_weak_hexes");
  std::map<std::string, Reference> table;
  while (std::getline(in, line)) {
    const auto fields = split_line(line);
    if (fields.size() > std::max(leaves, hexes))
      table[fields[0]] = {std::stod(fields[leaves]), std::stod(fields[hexes])};
  }
  return table;
}

struct Mode {
  const char* name;
  CompleteOptions complete;
  DualMode dual;
};

/// One grid in one mode.
struct Row {
  std::string grid;
  double input_leaves = 0, leaves = 0;
  DualReport report;
  Reference reference;
  double seconds = 0;

  double hexes() const { return static_cast<double>(report.num_hexes); }
  double growth() const { return leaves / input_leaves; }
  double of_reference() const { return hexes() / reference.hexes; }
  double per_leaf_of_reference() const { return of_reference() * reference.leaves / leaves; }
};

Row measure(const std::string& name, const Grid& input, const Mode& mode,
            const Reference& reference) {
  const Grid grid = complete(input, mode.complete, {}).grid;
  const auto start = std::chrono::steady_clock::now();
  Row row;
  row.report = build_dual(grid, {mode.dual, false, true}, {}).report;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  row.grid = name;
  row.input_leaves = static_cast<double>(input.num_cells());
  row.leaves = static_cast<double>(grid.num_cells());
  row.reference = reference;
  row.seconds = seconds.count();
  return row;
}

void print_row(const Row& row, const Mode& mode) {
  const DualReport& r = row.report;
  std::printf(
      "| %s | %s | %.0f | %.0f | %.2f | %zu | %.3f | %.3f | %zu | %.2f | %.2f | %.2f | %.2f |\n",
      row.grid.c_str(), mode.name, row.input_leaves, row.leaves, row.growth(), r.num_hexes,
      row.of_reference(), row.per_leaf_of_reference(), r.num_inverted_raw,
      r.min_scaled_jacobian_raw, r.min_scaled_jacobian, r.avg_scaled_jacobian, row.seconds);
}

template <class Value>
double mean(const std::vector<Row>& rows, Value&& value) {
  double sum = 0;
  for (const Row& row : rows) sum += value(row);
  return sum / static_cast<double>(rows.size());
}

template <class Value>
double least(const std::vector<Row>& rows, Value&& value) {
  double out = value(rows.front());
  for (const Row& row : rows) out = std::min<double>(out, value(row));
  return out;
}

void print_summary(const std::vector<Row>& rows, const Mode& mode) {
  std::printf("| %s | %.2f | %.3f (%.3f per leaf) | %.2f | %.2f | %.2f |\n", mode.name,
              mean(rows, [](const Row& r) { return r.growth(); }),
              mean(rows, [](const Row& r) { return r.of_reference(); }),
              mean(rows, [](const Row& r) { return r.per_leaf_of_reference(); }),
              least(rows, [](const Row& r) { return r.report.min_scaled_jacobian; }),
              least(rows, [](const Row& r) { return r.report.avg_scaled_jacobian; }),
              mean(rows, [](const Row& r) { return r.report.avg_scaled_jacobian; }));
}

/// Like against like: hexes over the reference's where both have the same number of leaves, and
/// per leaf over all grids together.
void print_equal_leaves(const std::vector<Row>& rows) {
  std::vector<Row> equal;
  double leaves = 0, hexes = 0, reference_leaves = 0, reference_hexes = 0;
  for (const Row& row : rows) {
    if (row.leaves == row.reference.leaves) equal.push_back(row);
    leaves += row.leaves;
    hexes += row.hexes();
    reference_leaves += row.reference.leaves;
    reference_hexes += row.reference.hexes;
  }
  if (equal.empty()) return;
  const auto ratio = [](const Row& r) { return r.of_reference(); };
  std::printf(
      "\nBlocks mode on the %zu grids with as many leaves as the reference's: hexes of reference "
      "%.4f in the mean, %.4f to %.4f. All grids together: %.4f hexes per leaf, the reference "
      "%.4f.\n\n",
      equal.size(), mean(equal, ratio), least(equal, ratio),
      -least(equal, [&](const Row& r) { return -ratio(r); }), hexes / leaves,
      reference_hexes / reference_leaves);
}

std::vector<std::filesystem::path> grid_files(const char* folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".cells") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

int run(const char* folder, const char* csv) {
  const Mode modes[] = {
      {"blocks, weak balance", {Balance::Weak, Pairing::Blocks}, DualMode::Blocks},
      {"sheets, weak balance", {Balance::Weak, Pairing::Sheets}, DualMode::Sheets},
      {"sheets, relaxed balance (default)", {Balance::Relaxed, Pairing::Sheets}, DualMode::Sheets}};
  const auto reference = read_reference(csv);
  std::vector<std::vector<Row>> rows(std::size(modes));
  for (const auto& path : grid_files(folder))
    for (std::size_t m = 0; m < std::size(modes); ++m)
      if (const auto found = reference.find(path.stem()); found != reference.end())
        rows[m].push_back(measure(path.stem(), read_grid(path), modes[m], found->second));
  if (rows[0].empty()) return 0;
  std::puts(
      "| mode | mean growth of leaves | mean hexes of reference | worst minimum | worst average | "
      "mean average |\n|---|--:|--:|--:|--:|--:|");
  for (std::size_t m = 0; m < std::size(modes); ++m) print_summary(rows[m], modes[m]);
  print_equal_leaves(rows[0]);
  std::puts(
      "| grid | mode | input leaves | leaves | growth | hexes | of reference | per leaf, of "
      "reference | inverted raw | raw min | min | avg | s |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (std::size_t i = 0; i < rows[0].size(); ++i)
    for (std::size_t m = 0; m < std::size(modes); ++m) print_row(rows[m][i], modes[m]);
  return 0;
}

}  // namespace
}  // namespace hexwright

int main(int argc, char** argv) {
  if (argc != 3) {
    std::puts("usage: dual_table GRID_DIR REFERENCE_CSV");
    return 2;
  }
  return hexwright::run(argv[1], argv[2]);
}
