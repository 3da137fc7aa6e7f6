// Geometric quality of hexahedra.
//
// Based on: Johnen, Weill, Remacle, "Robust and efficient validation of the linear hexahedral
// element", 2017 (Bezier).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/geometry/similarity.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/hex_shape.h"

namespace hexwright {

/// Whether the Jacobian determinant of the trilinear map is proven positive everywhere inside the
/// element, by its Bezier coefficients (subdivided a bounded number of times). Undecided means
/// neither proof succeeded.
enum class Positivity { Positive, NotPositive, Undecided };
Positivity check_positivity(const std::array<Vec3, 8>& p);

struct QualitySummary {
  std::size_t num_hexes = 0;
  std::size_t num_inverted = 0;  ///< scaled Jacobian <= 0
  double min_scaled_jacobian = 0, avg_scaled_jacobian = 0;
  HexId worst_hex;
  std::array<std::size_t, 20> histogram{};  ///< bins of 0.1 over [-1, 1]
  std::size_t num_not_positive = 0;         ///< Bezier test: proven not positive inside
  std::size_t num_undecided = 0;
  double total_volume = 0;

  void to_world(const Similarity& frame) { total_volume = frame.volume_to_world(total_volume); }
};
QualitySummary summarize_quality(const HexMesh& mesh);

/// Scaled Jacobian of each hex.
IdVector<HexId, double> compute_scaled_jacobians(const HexMesh& mesh);

}  // namespace hexwright
