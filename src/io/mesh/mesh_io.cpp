// Reads and writes hex and tet meshes: finds the format, checks what comes in and goes out.
#include "hexwright/io/mesh_io.h"

#include <algorithm>

#include "hexwright/io/atomic_file.h"

#include "io/mesh/volume_file.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright {
namespace io {
namespace {

/// A row of the table of formats; adding a format means adding its row and its file.
struct MeshFormat {
  const char* name;
  const char* extension;
  VolumeFile (*read)(const VolumeSource&);  ///< null: only written
  std::string (*write)(const HexMesh&, const WriteHexOptions&);
};

constexpr MeshFormat kFormats[] = {
    {"VTU", ".vtu", read_vtu, vtu_bytes},
    {"legacy VTK", ".vtk", read_vtk_legacy, vtk_legacy_bytes},
    {"MEDIT", ".mesh", read_medit,
     [](const HexMesh& mesh, const WriteHexOptions&) { return medit_text(mesh); }},
    {"Gmsh", ".msh", nullptr,
     [](const HexMesh& mesh, const WriteHexOptions&) { return gmsh_text(mesh); }},
    {"Abaqus", ".inp", nullptr,
     [](const HexMesh& mesh, const WriteHexOptions&) { return abaqus_text(mesh); }}};

const MeshFormat* find_format(const std::string& extension) {
  const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const MeshFormat& f) { return extension == f.extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

/// "VTU .vtu, legacy VTK .vtk, ..." of the formats that are read, or of all.
std::string list_formats(bool only_read) {
  std::string list;
  for (const MeshFormat& f : kFormats)
    if (f.read || !only_read)
      list += (list.empty() ? "" : ", ") + std::string(f.name) + " " + f.extension;
  return list;
}

/// The whole file is in memory while it is parsed: readers work on views into it.
VolumeFile read_volume_file(const std::filesystem::path& path) {
  const FileBytes file = read_file(path);
  return read_volume_bytes({file.bytes, file.name}, inner_extension(path));
}

std::string count_of(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

/// For messages about files that are read but hold the wrong kind of element.
std::string content_of(const VolumeFile& file) {
  return count_of(file.hexes.size(), "hexes, ") + count_of(file.tets.size(), "tets and ") +
         count_of(file.labels.quads.size() + file.labels.edges.size() + file.num_others,
                  "other elements");
}

/// Before a byte is written, so that a refused mesh leaves no file behind.
void check_writable(const HexMesh& mesh, const WriteHexOptions& options) {
  constexpr std::size_t kMostHexes = 200'000'000;  // 32-bit offsets of the formats
  if (const auto issue = mesh.find_problem())
    throw Error(ErrorCode::BadArgument, "the mesh cannot be written: " + issue->message);
  if (mesh.num_hexes() > kMostHexes)
    throw Error(ErrorCode::BadArgument, "the mesh has more than 2e8 hexes, too many for one file");
  for (const HexField& field : options.fields) {
    if (field.values.size() != mesh.num_hexes())
      throw Error(ErrorCode::BadArgument, "the field '" + field.name + "' has " +
                                              std::to_string(field.values.size()) + " values for " +
                                              std::to_string(mesh.num_hexes()) +
                                              " hexes; give one value per hex");
    if (field.name.empty() || field.name.find_first_of(" \t\r\n\"<>&") != std::string::npos)
      throw Error(ErrorCode::BadArgument,
                  "the field name '" + field.name + "' is empty or has blanks or quotes");
  }
}

}  // namespace

/// Content beats the name: magic words first, and only then the extension, which settles what has
/// no magic word of its own.
VolumeFile read_volume_bytes(const VolumeSource& source, const std::string& extension) {
  const std::string_view bytes = source.bytes;
  if (bytes.empty()) throw bad_file(source.name, "the file is empty; export it again");
  if (bytes.starts_with("# vtk DataFile")) return read_vtk_legacy(source);
  const std::string_view first = TextScanner(bytes, source.name).token();
  if (first.starts_with("<?xml") || first.starts_with("<VTKFile")) return read_vtu(source);
  if (first == "MeshVersionFormatted") return read_medit(source);
  const MeshFormat* format = find_format(extension);
  if (format && format->read) return format->read(source);
  throw bad_file(source.name,
                 "neither the content nor the extension is that of a known volume mesh format; "
                 "give a file of one of these: " +
                     list_formats(true));
}

/// Later kinds overwrite earlier ones: a corner lies on edges and quads too.
std::vector<std::uint8_t> compute_feature_flags(const HexMesh& mesh) {
  std::vector<std::uint8_t> flags(mesh.num_verts(), 0);
  for (const LabeledQuad& quad : mesh.labels.quads)
    for (VertId v : quad.verts) flags[v.index()] = 1;
  for (const LabeledEdge& edge : mesh.labels.edges)
    for (VertId v : edge.verts) flags[v.index()] = 2;
  for (VertId v : mesh.labels.corners) flags[v.index()] = 3;
  return flags;
}

}  // namespace io

HexMesh read_hex_mesh(const std::filesystem::path& path) {
  io::VolumeFile file = io::read_volume_file(path);
  if (file.hexes.empty())
    throw io::bad_file(path.string(), "the file holds no hexahedron (" + io::content_of(file) +
                                          "); give a hexahedral mesh");
  HexMesh mesh;
  mesh.positions = std::move(file.positions);
  mesh.hexes = std::move(file.hexes);
  mesh.region = IdVector<HexId, std::int32_t>(std::move(file.region));
  mesh.labels = std::move(file.labels);
  if (const auto issue = mesh.find_problem()) throw io::bad_file(path.string(), issue->message);
  return mesh;
}

TetMesh read_tet_mesh(const std::filesystem::path& path) {
  io::VolumeFile file = io::read_volume_file(path);
  if (file.tets.empty())
    throw io::bad_file(path.string(), "the file holds no tetrahedron (" + io::content_of(file) +
                                          "); give a tetrahedral mesh");
  TetMesh mesh;
  mesh.positions = std::move(file.positions);
  mesh.tets = std::move(file.tets);
  if (const auto issue = mesh.find_problem()) throw io::bad_file(path.string(), issue->message);
  return mesh;
}

void write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                    const WriteHexOptions& options) {
  io::check_writable(mesh, options);
  const std::string extension = io::lower_extension(path);
  const io::MeshFormat* format = io::find_format(extension);
  if (!format)
    throw Error(
        ErrorCode::BadArgument,
        "cannot write a hex mesh as '" + extension + "'; use one of " + io::list_formats(false),
        path.string());
  write_file_atomically(path, format->write(mesh, options));
}

const std::vector<std::string>& hex_mesh_extensions() {
  static const std::vector<std::string> kExtensions = [] {
    std::vector<std::string> list;
    for (const io::MeshFormat& f : io::kFormats) list.emplace_back(f.extension);
    return list;
  }();
  return kExtensions;
}

}  // namespace hexwright
