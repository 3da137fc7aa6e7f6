// Small surfaces with two named parts, in the text of formats that are only read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <zlib.h>

#include "io/text/byte_reader.h"

namespace hexwright::test {

/// A tetrahedron whose face at z = 0 is `base`, the others `roof`.
inline constexpr const char* kGmshTetrahedron =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 4 \"base\"\n2 5 \"roof\"\n"
    "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n7 0 0 1\n$EndNodes\n$Elements\n5\n"
    "1 2 2 4 1 1 3 2\n2 2 2 5 1 1 2 7\n3 2 2 5 1 2 3 7\n4 2 2 5 1 3 1 7\n5 1 2 9 1 1 2\n"
    "$EndElements\n";

inline constexpr const char* kVtkTetrahedron =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nFIELD FieldData 1\nbase 1 2 "
    "int\n4 2\n"
    "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
    "CELL_DATA 4\nSCALARS label int 1\nLOOKUP_TABLE default\n4 5 5 5\n";

inline constexpr const char* kVtpTetrahedron =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n"
    "<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"4\">\n<Points><DataArray "
    "type=\"Float32\" "
    "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 "
    "1</DataArray></Points>\n<Polys>"
    "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 1 2 3 2 0 3"
    "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>"
    "</Polys>\n<CellData><DataArray type=\"Int32\" Name=\"RegionId\" format=\"ascii\">4 5 5 5"
    "</DataArray></CellData>\n</Piece></PolyData></VTKFile>\n";

/// Shells before their grid points; a number without 'e', a card with all kinds of fields.
inline constexpr const char* kNastranTetrahedron =
    "$ a deck\n"
    "SOL 101\n"
    "CEND\n"
    "BEGIN BULK\n"
    "$HMNAME COMP                   4\"a component\" 3\n"
    "$HMNAME PROP                   4\"base\" 4\n"
    "$ Elements and Element Properties for region : roof\n"
    "PSHELL*                5               1              .1\n"
    "*\n"
    "CTRIA3         1       4       1       3       2\n"
    "CTRIA3,2,5,1,2,7\n"
    "CTRIA3*                3               5               2               3\n"
    "*                      7\n"
    "CTRIA3         4       5       3       1       7\n"
    "GRID           1              0.      0.      0.\n"
    "GRID,2,,1.+0,0.,0.\n"
    "GRID*                  3               0             0.0           1.D+0\n"
    "*                    0.0\n"
    "GRID           7             -0.      0.   10.-1\n"
    "ENDDATA\n"
    "nothing is read here\n";

/// A stored ZIP archive.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out, directory;
  const auto put = [](std::string& to, auto value) { io::store(to, value, io::ByteOrder::Little); };
  for (const auto& file : files) {
    const std::string &name = file.first, &bytes = file.second;
    const auto header = std::uint32_t(out.size()), size = std::uint32_t(bytes.size());
    const auto checksum = std::uint32_t(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
    const auto put_common = [&](std::string& to) {  // version, flags, method, time, date ...
      for (std::uint16_t value : {20, 0, 0, 0, 33}) put(to, value);
      for (std::uint32_t value : {checksum, size, size}) put(to, value);
      put(to, std::uint16_t(name.size()));
      put(to, std::uint16_t(0));
    };
    put(out, std::uint32_t{0x04034b50});
    put_common(out);
    out += name + bytes;
    put(directory, std::uint32_t{0x02014b50});
    put(directory, std::uint16_t{20});
    put_common(directory);
    for (int k = 0; k < 5; ++k) put(directory, std::uint16_t{0});
    put(directory, header);
    directory += name;
  }
  const auto begin = std::uint32_t(out.size());
  out += directory;
  put(out, std::uint32_t{0x06054b50});
  for (std::size_t value : {std::size_t{0}, std::size_t{0}, files.size(), files.size()})
    put(out, std::uint16_t(value));
  put(out, std::uint32_t(directory.size()));
  put(out, begin);
  put(out, std::uint16_t{0});
  return out;
}

/// Two tetrahedra: `bolt` as it is, and a component without a name, mirrored and shifted, of
/// `pair`.
inline const std::string k3mfModel =
    "<?xml version=\"1.0\"?><model unit=\"millimeter\"><resources><object id=\"1\" "
    "name=\"bolt\"><mesh>"
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" "
    "y=\"1\" "
    "z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" "
    "v3=\"1\"/>"
    "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle "
    "v1=\"2\" v2=\"0\" "
    "v3=\"3\"/></triangles></mesh></object><object id=\"2\" name=\"pair\"><components><component "
    "objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 9 0 "
    "0\"/></components></object></resources><build>"
    "<item objectid=\"1\"/><item objectid=\"2\"/></build></model>";

}  // namespace hexwright::test
