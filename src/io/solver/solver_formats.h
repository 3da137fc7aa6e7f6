// Writers of the formats that solvers read. Names in the tables fit the formats' rules already.
#pragma once

#include <string>
#include <vector>

#include "hexwright/io/mesh_io.h"
#include "hexwright/io/set_table.h"

#include "io/sets/node_table.h"
#include "io/text/folder_output.h"

namespace hexwright::io {

std::string abaqus_text(const NodeTable& nodes, const SetTable& table);
std::string ansys_text(const NodeTable& nodes, const SetTable& table);
std::string cgns_bytes(const NodeTable& nodes, const SetTable& table);
std::string exodus_bytes(const NodeTable& nodes, const SetTable& table);
std::string lsdyna_text(const HexMesh& mesh, const SetTable& table);
std::string med_bytes(const NodeTable& nodes, const SetTable& table);
std::string mfem_text(const NodeTable& nodes, const SetTable& table);
std::string nastran_text(const NodeTable& nodes, const SetTable& table);
std::string su2_text(const HexMesh& mesh, const SetTable& table);
std::string vtkhdf_bytes(const NodeTable& nodes, const SetTable& table,
                         const WriteHexOptions& options);
std::vector<FolderFile> openfoam_files(const HexMesh& mesh, const SetTable& table);

NameRules abaqus_names();
NameRules ansys_names();
NameRules cgns_names();
NameRules exodus_names();
NameRules lsdyna_names();
NameRules med_names();
NameRules mfem_names();
NameRules nastran_names();
NameRules su2_names();
NameRules vtkhdf_names();
NameRules openfoam_names();

}  // namespace hexwright::io
