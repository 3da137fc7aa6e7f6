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

/// The same proof for an element of second order; one of 20 nodes is the triquadratic one of the
/// same shape. `floor`: what the determinant, by coordinates in [0, 1], is to be greater than.
Positivity check_positivity(const QuadraticHex& nodes, double floor = 0);

/// What is known of the elements of a mesh of second order besides their corners.
struct SecondOrderQuality {
  std::size_t num_curved = 0;  ///< hexes with a mid-node off the middle of its edge
  std::size_t num_not_positive = 0, num_undecided = 0;
  std::vector<HexId> broken;  ///< the first of those proven not positive, kMaxListed at most
  /// The element whose least Jacobian at its 27 nodes is the smallest share of its mean Jacobian,
  /// which is 1 in a parallelepiped.
  HexId worst_hex;
  double min_jacobian_share = 1;
  double total_volume = 0;

  static constexpr std::size_t kMaxListed = 10;
  void to_world(const Similarity& frame) { total_volume = frame.volume_to_world(total_volume); }
};
/// Requires mid-nodes.
SecondOrderQuality summarize_second_order(const HexMesh& mesh);

/// Scaled Jacobian of each hex.
IdVector<HexId, double> compute_scaled_jacobians(const HexMesh& mesh);

}  // namespace hexwright
