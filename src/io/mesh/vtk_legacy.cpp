// Legacy VTK files (.vtk): writes version 4.2 in binary form.
//
// Based on: Kitware, "VTK File Formats" (the VTK User's Guide), section "Simple Legacy Formats".
// Binary data is big-endian whatever the machine.
#include "io/mesh/vtk_cells.h"
#include "io/text/byte_reader.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

void write_array(TextWriter& out, const VtkOutArray& array) {
  const std::size_t count = (array.is_int ? array.ints.size() : array.reals.size());
  out.text(array.name).text(" ").integer(array.num_components).text(" ");
  out.integer(count / array.num_components).text(array.is_int ? " int\n" : " double\n");
  for (std::int32_t value : array.ints) out.binary(value, ByteOrder::Big);
  for (double value : array.reals) out.binary(value, ByteOrder::Big);
  out.text("\n");
}

void write_field(TextWriter& out, const std::vector<VtkOutArray>& arrays) {
  if (arrays.empty()) return;
  out.text("FIELD FieldData ").integer(arrays.size()).text("\n");
  for (const VtkOutArray& array : arrays) write_array(out, array);
}

}  // namespace

VolumeFile read_vtk_legacy(const VolumeSource& source) {
  return to_volume_file(parse_vtk_legacy(source.bytes, source.name), source.name);
}

/// Version 4.2, which every reader takes; 64-bit offsets of version 5 would gain
/// nothing below 2^31 entries.
std::string vtk_legacy_bytes(const NodeTable& nodes, const SetTable& table,
                             const WriteHexOptions& options) {
  const VtkOutput data = make_vtk_output(nodes, table, options);
  const std::size_t num_cells = data.types.size();
  TextWriter out;
  out.text("# vtk DataFile Version 4.2\nhexwright\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
  write_field(out, data.field_data);
  out.text("POINTS ").integer(nodes.size()).text(" double\n");
  for (const Vec3& p : nodes.positions())
    for (int axis = 0; axis < 3; ++axis) out.binary(p[axis], ByteOrder::Big);
  out.text("\nCELLS ").integer(num_cells).text(" ");
  out.integer(num_cells + data.connectivity.size()).text("\n");
  std::int32_t begin = 0;
  for (std::int32_t end : data.ends) {
    out.binary(end - begin, ByteOrder::Big);
    for (; begin < end; ++begin)
      out.binary(data.connectivity[static_cast<std::size_t>(begin)], ByteOrder::Big);
  }
  out.text("\nCELL_TYPES ").integer(num_cells).text("\n");
  for (std::uint8_t type : data.types) out.binary(std::int32_t{type}, ByteOrder::Big);
  if (!data.cell_data.empty()) out.text("\nCELL_DATA ").integer(num_cells).text("\n");
  write_field(out, data.cell_data);
  if (!data.point_data.empty()) out.text("\nPOINT_DATA ").integer(nodes.size()).text("\n");
  write_field(out, data.point_data);
  return out.take();
}

}  // namespace hexwright::io
