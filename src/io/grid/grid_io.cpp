// Reads and writes adaptive grids: finds the format, and has make_grid check what was read.
#include "hexwright/io/grid_io.h"

#include "hexwright/io/atomic_file.h"

#include "io/grid/grid_file.h"
#include "io/mesh/vtk_cells.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright {
namespace io {
namespace {

/// A HyperTreeGrid by its first kilobyte, .cells by its extension or a leading number, and whatever
/// else reads as a volume mesh as a grid of hexes with hanging nodes.
GridFile read_grid_file(const std::filesystem::path& path) {
  const std::string extension = inner_extension(path);
  FileBytes file = read_file(path);
  const VolumeSource source = {file.bytes, file.name};
  if (file.bytes.empty()) throw bad_file(file.name, "the file is empty; write it again");
  const std::string_view head = std::string_view(file.bytes).substr(0, 1024);
  if (head.find("<VTKFile") != head.npos && head.find("HyperTreeGrid") != head.npos)
    return read_htg(source);
  const std::string_view first = TextScanner(file.bytes, file.name).token();
  const bool is_number = first.empty() || (first[0] >= '0' && first[0] <= '9');
  const bool is_legacy_vtk = head.starts_with("# vtk");
  if (!is_legacy_vtk && (extension == ".cells" || is_number)) return read_cells_file(source);
  return hexes_to_grid(read_volume_bytes(source, extension), file.name);
}

VtkOutArray frame_array(const char* name, std::vector<double> values) {
  VtkOutArray array;
  array.name = name;
  array.num_components = static_cast<int>(values.size());
  array.reals = std::move(values);
  return array;
}

/// The frame travels in the field data: without it a reader cannot know how large the root cubes
/// are when all of them are split.
std::string grid_vtu(const Grid& grid) {
  const HexMesh mesh = grid_to_hexes(grid);
  VtkOutput data = make_vtk_output(NodeTable(mesh, 8), {}, {});
  data.cell_data.front().name = "level";
  const auto& [origin, root_size, stretch] = grid.frame;
  data.field_data.push_back(frame_array("grid_frame", {origin.x, origin.y, origin.z, root_size}));
  if (!(stretch == Vec3{1, 1, 1}))
    data.field_data.push_back(frame_array("grid_stretch", {stretch.x, stretch.y, stretch.z}));
  return vtu_bytes(mesh.positions, data);
}

}  // namespace
}  // namespace io

/// make_grid knows the cell that is wrong but not the file, which is added here.
Grid read_grid(const std::filesystem::path& path) {
  io::GridFile file = io::read_grid_file(path);
  try {
    return make_grid(file.frame, std::move(file.roots), file.cells);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    throw Error(error.code(),
                std::string(error.what()) + "; correct the cells or write the grid again",
                path.string());
  }
}

void write_grid(const std::filesystem::path& path, const Grid& grid) {
  if (const auto issue = grid.find_problem())
    throw Error(ErrorCode::BadArgument, "the grid cannot be written: " + issue->message);
  constexpr std::size_t kMostCells = 200'000'000;  // 32-bit counts of the formats with hexes
  const std::string extension = io::lower_extension(path);
  if ((extension == ".mesh" || extension == ".vtu") && grid.num_cells() > kMostCells)
    throw Error(ErrorCode::BadArgument,
                "the grid has more than 2e8 cells, too many for this format; use .cells or .htg",
                path.string());
  if (extension == ".cells")
    write_file_atomically(path, io::cells_text(grid));
  else if (extension == ".htg")
    write_file_atomically(path, io::htg_bytes(grid));
  else if (extension == ".mesh")
    write_file_atomically(path, io::medit_text(io::grid_to_hexes(grid), {}));
  else if (extension == ".vtu")
    write_file_atomically(path, io::grid_vtu(grid));
  else
    throw Error(ErrorCode::BadArgument,
                "cannot write a grid as '" + extension + "'; use .cells, .htg, .vtu or .mesh",
                path.string());
}

}  // namespace hexwright
