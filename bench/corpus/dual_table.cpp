// Prints the table of docs/results/dual.md: every .cells grid of a folder in every mode.
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

void print_row(const std::string& name, const Grid& input, const Mode& mode,
               const Reference& reference) {
  const Grid grid = complete(input, mode.complete, {}).grid;
  const auto start = std::chrono::steady_clock::now();
  const auto r = build_dual(grid, {mode.dual, false, true}, {}).report;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto leaves = static_cast<double>(grid.num_cells());
  const auto hexes = static_cast<double>(r.num_hexes);
  std::printf(
      "| %s | %s | %zu | %.0f | %.2f | %.0f | %.3f | %.3f | %zu | %.2f | %.2f | %.2f | %.2f |\n",
      name.c_str(), mode.name, input.num_cells(), leaves,
      leaves / static_cast<double>(input.num_cells()), hexes, hexes / reference.hexes,
      hexes / leaves * reference.leaves / reference.hexes, r.num_inverted_raw,
      r.min_scaled_jacobian_raw, r.min_scaled_jacobian, r.avg_scaled_jacobian, seconds.count());
}

int run(const char* folder, const char* csv) {
  const Mode modes[] = {{"blocks", {Balance::Weak, Pairing::Blocks}, DualMode::Blocks},
                        {"sheets, weak", {Balance::Weak, Pairing::Sheets}, DualMode::Sheets},
                        {"sheets, relaxed", {Balance::Relaxed, Pairing::Sheets}, DualMode::Sheets}};
  const auto reference = read_reference(csv);
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".cells") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::puts(
      "| grid | mode | input leaves | leaves | growth | hexes | of reference | per leaf, of "
      "reference | inverted raw | raw min | min | avg | s |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (const auto& path : paths)
    for (const Mode& mode : modes)
      if (reference.count(path.stem()))
        print_row(path.stem(), read_grid(path), mode, reference.at(path.stem()));
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
