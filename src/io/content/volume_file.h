// What the readers of volume mesh formats collect, and the functions of each format.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/io/mesh_io.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tet_mesh.h"

#include "io/sets/node_table.h"

namespace hexwright::io {

/// Elements of one file. Indices are checked by the readers.
struct VolumeFile {
  IdVector<VertId, Vec3> positions;
  IdVector<HexId, std::array<VertId, 8>> hexes;
  std::vector<std::int32_t> region;       ///< one per hex, or empty
  std::vector<std::string> region_names;  ///< as in HexMesh
  std::optional<MidNodes> mid_nodes;      ///< when there are hexes of second order
  IdVector<TetId, std::array<VertId, 4>> tets;
  BoundaryLabels labels;
  std::size_t num_others = 0;      ///< elements of kinds that are left out
  std::vector<double> grid_frame;  ///< origin and root size when the file carries a grid, or empty
  std::vector<double> grid_stretch;  ///< its stretch, three values; empty = cubes, or not known
};

/// The bytes of a file and the name for messages.
struct VolumeSource {
  std::string_view bytes;
  const std::string& name;
};

VolumeFile read_medit(const VolumeSource& source);
VolumeFile read_vtk_legacy(const VolumeSource& source);
VolumeFile read_vtu(const VolumeSource& source);
VolumeFile read_gmsh(const VolumeSource& source);
VolumeFile read_abaqus(const VolumeSource& source);
VolumeFile read_mfem(const VolumeSource& source);
VolumeFile read_exodus(const VolumeSource& source);
/// Finds the format by content, then by extension.
VolumeFile read_volume_bytes(const VolumeSource& source, const std::string& extension);

std::string medit_text(const HexMesh& mesh, const SetTable& table);
std::string gmsh_text(const NodeTable& nodes, const SetTable& table);
std::string gmsh2_text(const NodeTable& nodes, const SetTable& table);
std::string vtk_legacy_bytes(const NodeTable& nodes, const SetTable& table,
                             const WriteHexOptions& options);
std::string vtu_bytes(const NodeTable& nodes, const SetTable& table,
                      const WriteHexOptions& options);

NameRules medit_names();
NameRules gmsh_names();
NameRules vtk_names();

/// Per node: 0 = inside the volume or unlabelled, 1 = on a labelled quad, 2 = on a labelled edge, 3
/// = corner.
std::vector<std::uint8_t> compute_feature_flags(const NodeTable& nodes);

/// Patch or curve number <-> the number in files whose 0 means "none": one more, 0 when invalid.
template <class IdType>
std::int32_t label_to_ref(IdType id) {
  return id.is_valid() ? id.value() + 1 : 0;
}
template <class IdType>
IdType ref_to_label(std::int64_t ref) {
  return ref > 0 && ref <= 0x7fffffff ? IdType(ref - 1) : IdType();
}

}  // namespace hexwright::io
