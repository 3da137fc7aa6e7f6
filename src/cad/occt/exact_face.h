// One face or edge of a CAD model as exact geometry: what it is, and the nearest point on it.
#pragma once

#include <optional>
#include <vector>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "hexwright/cad/cad_model.h"

namespace hexwright::cad {

/// A point of which the parameters are known, for the search to start from.
struct SurfaceSample {
  Vec3 point;
  double u = 0, v = 0;
};
struct CurveSample {
  Vec3 point;
  double t = 0;
};

class ExactFace {
 public:
  ExactFace(const TopoDS_Face& face, std::vector<SurfaceSample> samples);

  /// Fills kind, origin, axis and radii.
  void describe(CadFace& face) const;
  /// Planes and other elementary surfaces directly; others by Newton's method from the nearest
  /// sample, which ends at the nearest point it comes to, converged or not. Absent for faces
  /// without samples and where the point is not finite.
  std::optional<ExactPoint> project(const Vec3& p) const;
  /// Outward; absent at poles.
  std::optional<Vec3> normal(double u, double v) const;

 private:
  std::optional<std::array<double, 2>> parameters(const Vec3& p) const;
  std::optional<std::array<double, 2>> search(const Vec3& p) const;
  std::optional<std::array<double, 2>> step_towards(const Vec3& p, double u, double v) const;

  BRepAdaptor_Surface surface_;
  bool is_reversed_;
  std::vector<SurfaceSample> samples_;
};

class ExactEdge {
 public:
  ExactEdge(const TopoDS_Edge& edge, std::vector<CurveSample> samples);
  std::optional<ExactPoint> project(const Vec3& p) const;

 private:
  BRepAdaptor_Curve curve_;
  std::vector<CurveSample> samples_;  ///< in order, at least two
};

}  // namespace hexwright::cad
