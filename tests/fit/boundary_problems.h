// What is wrong with a mesh and its boundary after sheets went in.
#pragma once

#include <algorithm>
#include <string>

#include "hexwright/quality/hex_quality.h"

#include "fit/curves/boundary_state.h"

namespace hexwright::test {

inline double min_jacobian(const HexMesh& mesh) {
  const auto quality = compute_scaled_jacobians(mesh);
  return *std::min_element(quality.begin(), quality.end());
}

/// Empty when the mesh is conforming, not inverted, and the boundary agrees with it.
inline std::string problem_of(const relax::FitState& state,
                              const fitting::BoundaryState& boundary) {
  if (!compute_hex_neighbors(state.mesh).non_conforming.empty()) return "not conforming";
  if (!(min_jacobian(state.mesh) > 0)) return "inverted";
  const auto problem = boundary.find_problem(state);
  return problem ? problem->message : "";
}

}  // namespace hexwright::test
