// Reads and writes hex and tet meshes: finds the format, checks what comes in and goes out.
#include "hexwright/io/mesh_io.h"

#include <algorithm>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/set_summary.h"
#include "hexwright/mesh/cut_hexes.h"

#include "io/content/volume_file.h"
#include "io/solver/solver_formats.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/netcdf_file.h"
#include "io/text/text_scanner.h"

namespace hexwright {
namespace io {
namespace {

/// A row of the table of formats; adding a format means adding its row and its file.
struct MeshFormat {
  const char* name;
  const char* id;  ///< for WriteHexOptions::format
  const char* extension;
  VolumeFile (*read)(const VolumeSource&);  ///< null: only written
  NameRules (*names)();
  std::string (*write)(const NodeTable&, const SetTable&, const WriteHexOptions&);
  /// Nodes per hex of second order that the format has, the usual number first; 0: none.
  std::array<int, 2> second_order = {};
};

template <std::string (*Write)(const NodeTable&, const SetTable&)>
std::string without_options(const NodeTable& nodes, const SetTable& table, const WriteHexOptions&) {
  return Write(nodes, table);
}

template <std::string (*Write)(const HexMesh&, const SetTable&)>
std::string of_first_order(const NodeTable& nodes, const SetTable& table, const WriteHexOptions&) {
  return Write(nodes.mesh(), table);
}

constexpr MeshFormat kFormats[] = {
    {"VTU", "vtu", ".vtu", read_vtu, vtk_names, vtu_bytes, {20, 27}},
    {"legacy VTK", "vtk", ".vtk", read_vtk_legacy, vtk_names, vtk_legacy_bytes, {20, 27}},
    {"MEDIT", "medit", ".mesh", read_medit, medit_names, of_first_order<medit_text>},
    {"Gmsh 4.1", "gmsh", ".msh", read_gmsh, gmsh_names, without_options<gmsh_text>, {27, 20}},
    {"Gmsh 2.2", "gmsh2", ".msh2", read_gmsh, gmsh_names, without_options<gmsh2_text>, {27, 20}},
    {"Abaqus", "abaqus", ".inp", read_abaqus, abaqus_names, without_options<abaqus_text>, {20}},
    {"MFEM", "mfem", ".mfem", read_mfem, mfem_names, without_options<mfem_text>, {27}},
    {"Exodus II", "exodus", ".exo", read_exodus, exodus_names, without_options<exodus_bytes>, {20}},
    {"Nastran", "nastran", ".bdf", nullptr, nastran_names, without_options<nastran_text>, {20}},
    {"Ansys", "ansys", ".cdb", nullptr, ansys_names, without_options<ansys_text>, {20}},
    {"LS-DYNA", "lsdyna", ".k", nullptr, lsdyna_names, of_first_order<lsdyna_text>},
    {"SU2", "su2", ".su2", nullptr, su2_names, of_first_order<su2_text>},
    {"CGNS", "cgns", ".cgns", nullptr, cgns_names, without_options<cgns_bytes>, {27, 20}},
    {"MED", "med", ".med", nullptr, med_names, without_options<med_bytes>, {20}},
    {"VTKHDF", "vtkhdf", ".vtkhdf", nullptr, vtkhdf_names, vtkhdf_bytes, {20, 27}}};

/// The one format that is a folder.
constexpr const char* kOpenFoam = "openfoam";

bool is_openfoam(const std::filesystem::path& path, const std::string& format) {
  const auto name = path.has_filename() ? path.filename() : path.parent_path().filename();
  return format.empty() ? name == "polyMesh" : format == kOpenFoam;
}

const MeshFormat* find_format(const std::string& extension) {
  const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const MeshFormat& f) { return extension == f.extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

const MeshFormat* find_format(const std::filesystem::path& path, const std::string& id) {
  if (id.empty()) return find_format(lower_extension(path));
  const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const MeshFormat& f) { return id == f.id; });
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

bool has_nodes(const MeshFormat& format, int nodes) {
  return nodes != 0 && (format.second_order[0] == nodes || format.second_order[1] == nodes);
}

/// Of the formats that have hexes with so many nodes, or with any number of second order when 0.
std::string list_second_order(int nodes) {
  std::string list;
  for (const MeshFormat& f : kFormats)
    if (nodes == 0 ? f.second_order[0] != 0 : has_nodes(f, nodes))
      list += (list.empty() ? "" : ", ") + std::string(f.name) + " " + f.extension;
  return list;
}

void check_nodes_per_hex(const HexMesh& mesh, int wanted) {
  if (wanted != 0 && wanted != 8 && wanted != 20 && wanted != 27)
    throw Error(ErrorCode::BadArgument, "hexes have no " + std::to_string(wanted) +
                                            " nodes; give 20 or 27, or 8 to leave mid-nodes out");
  if (wanted > 8 && !mesh.mid_nodes)
    throw Error(ErrorCode::BadArgument, "the mesh is of first order and has no " +
                                            std::to_string(wanted) +
                                            " nodes per hex; make it of second order first");
}

/// Of hexes of second order, `wanted` or the usual number. Throws Error{BadArgument} when the
/// format (null: OpenFOAM) does not have it.
int choose_nodes(const MeshFormat* format, int wanted, const std::filesystem::path& path) {
  const std::string name = format ? format->name : "OpenFOAM";
  if (!format || format->second_order[0] == 0)
    throw Error(ErrorCode::BadArgument,
                name + " has no hexes of second order; use one of " + list_second_order(0) +
                    ", or --order 1",
                path.string());
  if (wanted != 0 && !has_nodes(*format, wanted))
    throw Error(ErrorCode::BadArgument,
                name + " has no hexes of " + std::to_string(wanted) + " nodes; use one of " +
                    list_second_order(wanted),
                path.string());
  return wanted != 0 ? wanted : format->second_order[0];
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

/// Names that no format has to escape, and that are no array's of the writers.
void check_field_name(const HexField& field, const WriteHexOptions& options) {
  const std::string& name = field.name;
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::BadArgument, "the field name '" + name + "' " + what);
  };
  if (name.empty() || name.find_first_of(" \t\r\n\"<>&/") != std::string::npos)
    refuse("is empty or has blanks, line ends, '\"', '<', '>', '&' or '/'; give another");
  if (name == "region" || (options.write_sets && (name == "patch" || name == "curve")))
    refuse("is that of the mesh's own numbers in the file; give another");
  if (std::ranges::count(options.fields, name, &HexField::name) > 1)
    refuse("is given twice; give each field its own");
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
    check_field_name(field, options);
  }
}

}  // namespace

/// Content beats the name: magic words first, and only then the extension, which settles what has
/// no magic word of its own.
VolumeFile read_volume_bytes(const VolumeSource& source, const std::string& extension) {
  const std::string_view bytes = source.bytes;
  if (bytes.empty()) throw bad_file(source.name, "the file is empty; export it again");
  if (bytes.starts_with("# vtk DataFile")) return read_vtk_legacy(source);
  if (is_netcdf_classic(bytes) || is_hdf5(bytes)) return read_exodus(source);
  const std::string_view first = TextScanner(bytes, source.name).token();
  if (first.starts_with("<?xml") || first.starts_with("<VTKFile")) return read_vtu(source);
  if (first == "MeshVersionFormatted") return read_medit(source);
  if (first == "$MeshFormat") return read_gmsh(source);
  if (first == "MFEM") return read_mfem(source);
  const MeshFormat* format = find_format(extension);
  if (format && format->read) return format->read(source);
  throw bad_file(source.name,
                 "neither the content nor the extension is that of a known volume mesh format; "
                 "give a file of one of these: " +
                     list_formats(true));
}

/// Later kinds overwrite earlier ones: a corner lies on edges and quads too.
std::vector<std::uint8_t> compute_feature_flags(const NodeTable& nodes) {
  const HexMesh& mesh = nodes.mesh();
  std::vector<std::uint8_t> flags(nodes.size(), 0);
  for (const LabeledQuad& quad : mesh.labels.quads)
    for (VertId v : nodes.quad(quad.verts)) flags[v.index()] = 1;
  for (const LabeledEdge& edge : mesh.labels.edges)
    for (VertId v : nodes.edge(edge.verts)) flags[v.index()] = 2;
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
  mesh.region_names = std::move(file.region_names);
  mesh.labels = std::move(file.labels);
  mesh.mid_nodes = std::move(file.mid_nodes);
  if (const auto issue = mesh.find_problem()) throw io::bad_file(path.string(), issue->message);
  return mesh;
}

TetMesh read_tet_mesh(const std::filesystem::path& path) {
  io::VolumeFile file = io::read_volume_file(path);
  if (file.tets.empty() && file.hexes.empty())
    throw io::bad_file(path.string(), "the file holds no tetrahedron and no hexahedron (" +
                                          io::content_of(file) + "); give a mesh of one of them");
  TetMesh mesh;
  if (file.tets.empty()) {
    HexMesh hexes;
    hexes.positions = std::move(file.positions);
    hexes.hexes = std::move(file.hexes);
    if (const auto issue = hexes.find_problem()) throw io::bad_file(path.string(), issue->message);
    return cut_hexes(hexes);
  }
  mesh.positions = std::move(file.positions);
  mesh.tets = std::move(file.tets);
  if (const auto issue = mesh.find_problem()) throw io::bad_file(path.string(), issue->message);
  return mesh;
}

WriteHexResult write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh,
                              const WriteHexOptions& options) {
  io::check_writable(mesh, options);
  io::check_nodes_per_hex(mesh, options.nodes_per_hex);
  const bool is_linear = !mesh.mid_nodes || options.nodes_per_hex == 8;
  check_hex_mesh_format(path, options.format, is_linear ? 1 : 2, options.nodes_per_hex);
  WriteHexResult result;
  SetTable table = make_set_table(mesh);
  if (options.names_by_place) name_by_place(mesh, table);
  if (io::is_openfoam(path, options.format)) {
    result.changed_names = apply_name_rules(io::openfoam_names(), table);
    io::write_folder_atomically(path, io::openfoam_files(mesh, table));
    return result;
  }
  const io::MeshFormat* format = io::find_format(path, options.format);
  result.changed_names = apply_name_rules(format->names(), table);
  const io::NodeTable nodes(mesh,
                            is_linear ? 8 : io::choose_nodes(format, options.nodes_per_hex, path));
  write_file_atomically(path, format->write(nodes, table, options));
  return result;
}

void check_hex_mesh_format(const std::filesystem::path& path, const std::string& format, int order,
                           int nodes_per_hex) {
  const io::MeshFormat* found = io::find_format(path, format);
  if (io::is_openfoam(path, format) || found) {
    if (order == 2)
      io::choose_nodes(io::is_openfoam(path, format) ? nullptr : found, nodes_per_hex, path);
    return;
  }
  if (!format.empty()) {
    std::string list;
    for (const std::string& known : hex_mesh_formats()) list += (list.empty() ? "" : ", ") + known;
    throw Error(ErrorCode::BadArgument, "there is no format '" + format + "'; use one of " + list);
  }
  throw Error(ErrorCode::BadArgument,
              "cannot write a hex mesh as '" + io::lower_extension(path) + "'; use one of " +
                  io::list_formats(false) + ", or OpenFOAM polyMesh (a folder of this name)",
              path.string());
}

const std::vector<std::string>& hex_mesh_formats() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> list;
    for (const io::MeshFormat& f : io::kFormats) list.emplace_back(f.id);
    list.emplace_back(io::kOpenFoam);
    return list;
  }();
  return kNames;
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
