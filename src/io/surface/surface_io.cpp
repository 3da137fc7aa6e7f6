// Reads and writes surfaces: finds the format by content, then by extension.
#include "hexwright/io/surface_io.h"

#include <map>
#include <optional>

#include "hexwright/io/atomic_file.h"

#include "io/surface/polygon_soup.h"
#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"
#include "io/text/text_writer.h"
#include "io/text/zip_archive.h"

namespace hexwright {
namespace io {
namespace {

/// A row of the table of formats; adding one means adding a row and its test of the content.
struct SurfaceFormat {
  const char* name;
  const char* extensions;  ///< with blanks between
  PolygonSoup (*read)(const SurfaceSource&);
};

constexpr SurfaceFormat kObj = {"OBJ", ".obj", read_obj};
constexpr SurfaceFormat kOff = {"OFF", ".off", read_off};
constexpr SurfaceFormat kStlText = {"STL (text)", ".stl", read_stl_ascii};
constexpr SurfaceFormat kStlBinary = {"STL (binary)", ".stl", read_stl_binary};
constexpr SurfaceFormat kPly = {"PLY", ".ply", read_ply};
constexpr SurfaceFormat kVtp = {"VTK XML", ".vtp .vtu", read_vtk_xml_surface};
constexpr SurfaceFormat kVtk = {"legacy VTK", ".vtk", read_vtk_legacy_surface};
constexpr SurfaceFormat kGmsh = {"Gmsh", ".msh .msh2", read_gmsh_surface};
constexpr SurfaceFormat kNastran = {"Nastran", ".bdf .nas .dat .fem", read_nastran_surface};
constexpr SurfaceFormat k3mf = {"3MF", ".3mf", read_3mf};

constexpr const char* kKnownFormats =
    "give an OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF file";

bool has_extension(const SurfaceFormat& format, const std::string& extension) {
  const std::string all = std::string(format.extensions) + " ";
  return !extension.empty() && all.find(extension + " ") != std::string::npos;
}

/// The first words of real OBJ files. Rarer ones alone do not prove the format; the extension does.
bool is_obj_keyword(std::string_view token) {
  for (std::string_view known : {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"})
    if (token == known) return true;
  return false;
}

/// "solid" at the start, text in the first kilobyte, and a facet or the end of the solid in it.
bool is_text_stl(const FileBytes& file, std::string_view first_token) {
  if (!equals_ignoring_case(first_token, "solid")) return false;
  const std::string_view head = std::string_view(file.bytes).substr(0, 1024);
  if (head.find('\0') != std::string_view::npos) return false;
  for (std::string_view word : {"facet", "FACET", "Facet", "endsolid", "ENDSOLID"})
    if (head.find(word) != std::string_view::npos) return true;
  return false;
}

bool is_xml_of_vtk(std::string_view bytes) {
  return bytes.substr(0, 1024).find("<VTKFile") != std::string_view::npos;
}

/// In an order that settles doubts: magic words, then an exact size, then words a header might hold
/// by chance. Binary STL comes before text STL because many binary files begin with "solid".
std::optional<SurfaceFormat> find_format_by_content(const FileBytes& file) {
  const std::string_view bytes = file.bytes;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return kPly;
  if (bytes.starts_with("# vtk DataFile")) return kVtk;
  if (is_zip(bytes)) return k3mf;
  const std::string_view first = TextScanner(bytes, file.name).token();
  if (is_xml_of_vtk(bytes)) return kVtp;
  if (is_off_keyword(first)) return kOff;
  if (is_exact_binary_stl(bytes)) return kStlBinary;
  if (is_text_stl(file, first)) return kStlText;
  if (first == "$MeshFormat") return kGmsh;
  if (first == "GRID" || first == "GRID*" || first.starts_with("GRID,")) return kNastran;
  if (is_obj_keyword(first)) return kObj;
  return std::nullopt;
}

std::optional<SurfaceFormat> find_format_by_extension(const FileBytes& file,
                                                      const std::string& extension) {
  if (extension == ".obj") return kObj;
  if (extension == ".off") return kOff;
  if (extension == ".stl") return kStlBinary;
  if (has_extension(kNastran, extension)) return kNastran;
  if (extension == ".ply")
    throw bad_file(file.name,
                   "the file does not begin with 'ply': it is no PLY file; export it again");
  return std::nullopt;
}

/// Content beats the name, since files are renamed more often than they are damaged.
SurfaceFormat find_format(const FileBytes& file, const std::string& extension,
                          std::vector<std::string>& warnings) {
  if (file.bytes.empty()) throw bad_file(file.name, "the file is empty; export it again");
  if (const auto found = find_format_by_content(file)) {
    if (!has_extension(*found, extension))
      warnings.push_back(
          std::string("the content is ") + found->name + " although the name ends in " +
          (extension.empty() ? "nothing" : "'" + extension + "'") + "; read as " + found->name);
    return *found;
  }
  if (const auto assumed = find_format_by_extension(file, extension)) return *assumed;
  throw bad_file(
      file.name,
      std::string("neither the content nor the extension is that of a surface format; ") +
          kKnownFormats);
}

/// The name of a triangle's group, "" without one.
const std::string& group_name(const TriMesh& surface, TriId t) {
  static const std::string kNone;
  return surface.group.empty() || surface.group[t] < 0
             ? kNone
             : surface.group_names[static_cast<std::size_t>(surface.group[t])];
}

/// Shortest decimal forms that give the same doubles back. Groups are named where they begin.
std::string obj_text(const TriMesh& surface) {
  TextWriter out;
  for (const Vec3& p : surface.positions) out.text("v ").point(p).text("\n");
  std::string_view named;
  for (TriId t : surface.tris.ids()) {
    if (group_name(surface, t) != named) {
      named = group_name(surface, t);
      out.text(named.empty() ? "g" : "g ").text(named).text("\n");
    }
    out.text("f ").indices(surface.tris[t], 1).text("\n");
  }
  return out.take();
}

std::string off_text(const TriMesh& surface) {
  TextWriter out;
  out.text("OFF\n").integer(surface.num_verts()).text(" ").integer(surface.num_tris());
  out.text(" 0\n");
  for (const Vec3& p : surface.positions) out.point(p).text("\n");
  for (const auto& t : surface.tris) out.text("3 ").indices(t, 0).text("\n");
  return out.take();
}

/// Text with one solid per group, since the binary form has no names; in single precision too, so
/// that both forms hold the same surface.
std::string named_stl_text(const TriMesh& surface) {
  std::map<std::string_view, std::vector<TriId>> solids;
  for (TriId t : surface.tris.ids()) solids[group_name(surface, t)].push_back(t);
  TextWriter out;
  const auto put = [&](const char* before, const Vec3& p) {
    out.text(before);
    for (int axis = 0; axis < 3; ++axis) out.text(" ").single(static_cast<float>(p[axis]));
    out.text("\n");
  };
  for (const auto& [name, tris] : solids) {
    out.text("solid ").text(name).text("\n");
    for (TriId t : tris) {
      const auto p = surface.corners(t);
      put("facet normal", normalized(cross(p[1] - p[0], p[2] - p[0])));
      out.text("outer loop\n");
      for (const Vec3& corner : p) put("vertex", corner);
      out.text("endloop\nendfacet\n");
    }
    out.text("endsolid ").text(name).text("\n");
  }
  return out.take();
}

/// Single precision is all the format has; normals are written for programs that shade by them.
std::string stl_bytes(const TriMesh& surface) {
  std::string out(80, ' ');
  out.replace(0, 9, "hexwright");
  store(out, static_cast<std::uint32_t>(surface.num_tris()), ByteOrder::Little);
  const auto put = [&](const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) store(out, static_cast<float>(p[axis]), ByteOrder::Little);
  };
  for (TriId t : surface.tris.ids()) {
    const auto p = surface.corners(t);
    put(normalized(cross(p[1] - p[0], p[2] - p[0])));
    for (const Vec3& corner : p) put(corner);
    store(out, std::uint16_t{0}, ByteOrder::Little);
  }
  return out;
}

/// Double precision, so that nothing is lost between our own runs.
std::string ply_bytes(const TriMesh& surface) {
  const bool is_named = !surface.group.empty();
  TextWriter header;
  header.text("ply\nformat binary_little_endian 1.0\ncomment hexwright\n");
  for (std::size_t g = 0; g < surface.group_names.size(); ++g)
    header.text("comment group ").integer(g).text(" ").text(surface.group_names[g]).text("\n");
  header.text("element vertex ").integer(surface.num_verts());
  header.text("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
  header.integer(surface.num_tris());
  header.text("\nproperty list uchar int vertex_indices\n");
  header.text(is_named ? "property int group\nend_header\n" : "end_header\n");
  std::string out = header.take();
  for (const Vec3& p : surface.positions)
    for (int axis = 0; axis < 3; ++axis) store(out, p[axis], ByteOrder::Little);
  for (TriId t : surface.tris.ids()) {
    out.push_back(3);
    for (VertId v : surface.tris[t]) store(out, v.value(), ByteOrder::Little);
    if (is_named) store(out, surface.group[t], ByteOrder::Little);
  }
  return out;
}

}  // namespace
}  // namespace io

SurfaceFile read_surface(const std::filesystem::path& path) {
  const io::FileBytes file = io::read_file(path);
  SurfaceFile result;
  if (file.was_packed && io::lower_extension(path) != ".gz")
    result.warnings.push_back(
        "the content is packed by gzip although the name does not end in '.gz'");
  const auto format = io::find_format(file, io::inner_extension(path), result.warnings);
  result.format = format.name;
  io::PolygonSoup soup = format.read({file.bytes, file.name, result.warnings});
  if (soup.positions.size() > io::kMaxElements)
    throw io::bad_file(file.name, "more than 2^31 vertices; simplify the surface first");
  result.mesh = io::triangulate(std::move(soup));
  if (result.mesh.num_tris() == 0)
    throw io::bad_file(file.name, "the file holds no face; export the model as a surface mesh");
  return result;
}

void write_surface(const std::filesystem::path& path, const TriMesh& surface) {
  if (const auto issue = surface.find_problem())
    throw Error(ErrorCode::BadArgument, "the surface cannot be written: " + issue->message);
  const std::string extension = io::lower_extension(path);
  if (extension == ".obj")
    write_file_atomically(path, io::obj_text(surface));
  else if (extension == ".off")
    write_file_atomically(path, io::off_text(surface));
  else if (extension == ".stl")
    write_file_atomically(
        path, surface.group.empty() ? io::stl_bytes(surface) : io::named_stl_text(surface));
  else if (extension == ".ply")
    write_file_atomically(path, io::ply_bytes(surface));
  else
    throw Error(ErrorCode::BadArgument,
                "cannot write a surface as '" + extension + "'; use .obj, .off, .stl or .ply",
                path.string());
}

}  // namespace hexwright
