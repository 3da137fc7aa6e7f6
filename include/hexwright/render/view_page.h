// A hex mesh as one HTML page to look into: cut, peel, filter by quality, worst hexes, names. The
// page needs no network and nothing but a browser (docs/viewer.md); viewer/ has its sources.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hexwright/geometry/surface_tree.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/quality/judge.h"

namespace hexwright {

struct ViewOptions {
  std::string title = "mesh";
  /// A mesh of more hexes is shown by its skin, slices through it and its worst hexes, and the page
  /// says so.
  std::size_t max_whole_hexes = 2'000'000;
  /// More to colour by, one value per hex: e.g. the grid's level. Each needs a name of its own.
  std::vector<HexField> fields;
  /// What was said about the mesh; its failures and figures are shown. Null = not judged.
  const Verdict* verdict = nullptr;
  /// Drawn over the mesh, whose boundary can then be coloured by its distance. Null = none.
  const SurfaceTree* surface = nullptr;
};

/// The whole page. The same bytes for any number of threads. Positions are quantised to 1/65535 of
/// the box for drawing; measures are those of the mesh itself. Throws Error{BadArgument} for a mesh
/// without hexes, an index out of range, or a field whose number of values is not that of the
/// hexes.
std::string make_view_page(const HexMesh& mesh, const ViewOptions& options);

}  // namespace hexwright
