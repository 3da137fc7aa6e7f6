// The faces, edges and corners of a polycube that a labelled surface describes.
//
// Based on: Livesu, Vining, Sheffer, Gregson, Scateni, "PolyCut", ACM TOG 32(6), 2013; Mestrallet,
// Protais, Bourcier, Ledoux, "Limits and prospects of polycube labelings", 2023, for what makes a
// labelling valid: after Eppstein, Mumford, "Steinitz theorems for orthogonal polyhedra", 2010.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// 0 to 5: +x, -x, +y, -y, +z, -z.
inline int label_axis(std::uint8_t label) { return label / 2; }
inline int label_sign(std::uint8_t label) { return label % 2 == 0 ? 1 : -1; }
/// "+x" ...
std::string label_name(std::uint8_t label);

struct LabelCharts {
  IdVector<TriId, int> chart;             ///< per triangle
  std::vector<std::uint8_t> chart_label;  ///< per chart
  std::vector<VertId> corners;            ///< where three charts meet, ascending
};

/// Connected triangles of one label are a chart. Requires a closed surface, oriented outwards, with
/// one label per triangle.
/// Errors: BadGeometry where a direction is missing, and, with the place and the remedy, where
/// charts of one axis share an edge, where other than three charts of three axes meet in a corner,
/// or where a chart's border has fewer than four corners.
LabelCharts find_label_charts(const TriMesh& surface, std::span<const std::uint8_t> labels);

}  // namespace hexwright
