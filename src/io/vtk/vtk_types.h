// Numbers of VTK's types of cells.
#pragma once

#include <cstdint>

namespace hexwright::io {

enum VtkCellType : std::int32_t {
  VtkVertex = 1,
  VtkPolyVertex = 2,
  VtkLine = 3,
  VtkPolyLine = 4,
  VtkTriangle = 5,
  VtkTriangleStrip = 6,
  VtkPolygon = 7,
  VtkPixel = 8,
  VtkQuad = 9,
  VtkTetra = 10,
  VtkVoxel = 11,
  VtkHexahedron = 12,
  VtkWedge = 13,
  VtkPyramid = 14,
  VtkQuadraticEdge = 21,
  VtkQuadraticTriangle = 22,
  VtkQuadraticQuad = 23,
  VtkQuadraticHexahedron = 25,
  VtkBiquadraticQuad = 28,
  VtkTriquadraticHexahedron = 29
};

/// Types of cells for each number of nodes per hex.
struct VtkTypes {
  VtkCellType line, quad, hex;
};
inline VtkTypes vtk_types(int nodes_per_hex) {
  if (nodes_per_hex == 27) return {VtkQuadraticEdge, VtkBiquadraticQuad, VtkTriquadraticHexahedron};
  if (nodes_per_hex == 20) return {VtkQuadraticEdge, VtkQuadraticQuad, VtkQuadraticHexahedron};
  return {VtkLine, VtkQuad, VtkHexahedron};
}

}  // namespace hexwright::io
