// The formats of adaptive grids.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hexwright/io/grid_io.h"

#include "io/content/volume_file.h"

namespace hexwright::io {

/// What a grid file says, before make_grid checks it.
struct GridFile {
  GridFrame frame;
  std::vector<LatticeCoord> roots;
  std::vector<CellSpec> cells;
};

GridFile read_cells_file(const VolumeSource& source);
GridFile read_htg(const VolumeSource& source);
/// Hexes with hanging nodes, from any program, as cells. Every hex must be an axis-aligned box of
/// the others' proportions.
GridFile hexes_to_grid(const VolumeFile& file, const std::string& name);

std::string cells_text(const Grid& grid);
std::string htg_bytes(const Grid& grid);
/// One hex per leaf, vertices shared: non-conforming where levels meet. The region is the level.
HexMesh grid_to_hexes(const Grid& grid);

/// The distinct root cubes that hold these cells, sorted (z, y, x).
std::vector<LatticeCoord> find_roots(std::span<const CellSpec> cells);

}  // namespace hexwright::io
