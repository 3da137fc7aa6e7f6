// Pages to look into a mesh with.
#pragma once

#include <string>

#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/render/view_page.h"

namespace hexwright::cli {

/// Writes the page of a mesh, whole or not at all.
void write_view(const std::string& path, const HexMesh& mesh, const ViewOptions& options);

/// The page of what the pipeline made: with its verdict, the input surface and the grid's levels.
void write_view(const std::string& path, const MeshResult& result, const TriMesh& surface,
                const std::string& title);

/// Hands a file to the desktop's browser; false where there is no desktop or none that could be
/// asked.
bool open_in_browser(const std::string& path);

}  // namespace hexwright::cli
