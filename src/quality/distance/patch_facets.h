// The boundary quads of a hex mesh as the curved patches that solvers integrate over, by facets
// whose distance from the patch is bounded.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

/// Patches of quads: bilinear, or of second order by the mid-nodes of their sides (serendipity).
class QuadPatches {
 public:
  /// Of `quads`, counter-clockwise seen from outside. The mesh must outlive the patches.
  QuadPatches(const HexMesh& mesh, const std::vector<std::array<VertId, 4>>& quads);

  std::size_t size() const { return quads_.size(); }

  /// A bound on how far any point of the patch is from its facets, and any of theirs from it, with
  /// `divisions` of each side.
  double facet_error(std::size_t quad, int divisions) const {
    return error_[quad] / (divisions * divisions);
  }
  /// The least number of divisions, at most `most`, with which the error is no more than this.
  int divisions_for(std::size_t quad, double error, int most) const;

  /// Appends 4 facets for each of divisions x divisions parts of the patch, about their centres;
  /// all their vertices are points of the patch.
  void append_facets(std::size_t quad, int divisions, TriMesh& triangles) const;

  struct PointBounds {
    double lower = 0, upper = 0;
    std::size_t nearest = 0;  ///< a quad that is no farther than the upper bound
  };
  /// Of the distance from p to the nearest patch; no more than `gap` apart where doubles tell.
  PointBounds bound_distance(const Vec3& p, double gap) const;

 private:
  Vec3 point(std::size_t quad, double u, double v) const;
  double distance_to_facets(std::size_t quad, int divisions, const Vec3& p) const;

  const HexMesh& mesh_;
  std::vector<std::array<VertId, 4>> quads_;
  std::vector<std::array<Vec3, 9>> curved_;  // of second order, else empty
  std::vector<double> error_;                // with one division
};

/// Facets of some patches, each with the quad it belongs to and its error.
struct PatchFacets {
  TriMesh triangles;
  std::vector<std::int32_t> tri_to_quad;
  std::vector<double> tri_error;
};

/// `divisions`: of each patch; 0 = without facets.
PatchFacets make_facets(const QuadPatches& patches, const std::vector<int>& divisions);

}  // namespace hexwright
