// Reads and writes adaptive grids: .cells (plain text), non-conforming MEDIT/VTU hexes, VTK
// HyperTreeGrid (.htg).
#pragma once

#include <filesystem>

#include "hexwright/grid/grid.h"

namespace hexwright {

/// `.cells`: one leaf per line `level i j k`; `#` comments; `# roots i j k ...`; `# origin x y z
/// size h`. Also MEDIT and VTU hex files with hanging nodes (as other programs write adaptive
/// grids), and .htg. Throws Error{CannotOpen} or Error{BadFile} naming the line or cell.
Grid read_grid(const std::filesystem::path& path);

/// By extension: .cells, .mesh, .vtu, .htg. Whole or not at all.
void write_grid(const std::filesystem::path& path, const Grid& grid);

}  // namespace hexwright
