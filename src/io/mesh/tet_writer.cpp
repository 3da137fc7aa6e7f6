// Tet meshes, as pairs for polycube maps need them: positions and elements, nothing else.
#include "hexwright/io/atomic_file.h"
#include "hexwright/io/mesh_io.h"

#include "io/text/file_bytes.h"
#include "io/text/text_writer.h"
#include "io/vtk/vtk_types.h"

namespace hexwright {
namespace {

std::string medit_tets(const TetMesh& mesh) {
  io::TextWriter out;
  out.text("MeshVersionFormatted 2\nDimension 3\n\nVertices\n").integer(mesh.num_verts());
  out.text("\n");
  for (const Vec3& p : mesh.positions) out.point(p).text(" 0\n");
  out.text("\nTetrahedra\n").integer(mesh.num_tets()).text("\n");
  for (const auto& tet : mesh.tets) out.indices(tet, 1).text(" 0\n");
  return out.text("\nEnd\n").take();
}

std::string vtk_tets(const TetMesh& mesh) {
  io::TextWriter out;
  out.text("# vtk DataFile Version 3.0\nhexwright\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ");
  out.integer(mesh.num_verts()).text(" double\n");
  for (const Vec3& p : mesh.positions) out.point(p).text("\n");
  out.text("CELLS ").integer(mesh.num_tets()).text(" ").integer(5 * mesh.num_tets()).text("\n");
  for (const auto& tet : mesh.tets) out.text("4 ").indices(tet, 0).text("\n");
  out.text("CELL_TYPES ").integer(mesh.num_tets()).text("\n");
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) out.integer(int{io::VtkTetra}).text("\n");
  return out.take();
}

}  // namespace

void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  const std::string extension = io::lower_extension(path);
  if (extension == ".vtk") return write_file_atomically(path, vtk_tets(mesh));
  if (extension == ".mesh") return write_file_atomically(path, medit_tets(mesh));
  throw Error(ErrorCode::BadArgument,
              "cannot write tets as '" + extension + "'; use .mesh (MEDIT) or .vtk (legacy VTK)",
              path.string());
}

}  // namespace hexwright
