// Nearest points by Newton's method on the squared distance, started from the triangulation's
// nodes, which lie within its deflection of the exact shape.
#include "cad/occt/exact_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ElSLib.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>

#include "cad/occt/occt.h"

namespace hexwright::cad {
namespace {

constexpr int kMostSteps = 30;
/// Of the parameters' range: steps below are rounding.
constexpr double kSmallStep = 1e-13;

template <class Sample>
const Sample* nearest(const std::vector<Sample>& samples, const Vec3& p) {
  const Sample* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples)
    if (const double d = norm_sq(sample.point - p); d < least) {
      least = d;
      best = &sample;
    }
  return best;
}

}  // namespace

ExactFace::ExactFace(const TopoDS_Face& face, std::vector<SurfaceSample> samples)
    : surface_(face, false),
      is_reversed_(face.Orientation() == TopAbs_REVERSED),
      samples_(std::move(samples)) {}

void ExactFace::describe(CadFace& face) const {
  const auto set = [&](CadSurfaceKind kind, const gp_Ax3& axes, double radius, double minor) {
    face.kind = kind;
    face.origin = to_vec3(axes.Location());
    face.axis = to_vec3(axes.Direction());
    face.radius = radius;
    face.minor = minor;
  };
  switch (surface_.GetType()) {
    case GeomAbs_Plane:
      return set(CadSurfaceKind::Plane, surface_.Plane().Position(), 0, 0);
    case GeomAbs_Cylinder:
      return set(CadSurfaceKind::Cylinder, surface_.Cylinder().Position(),
                 surface_.Cylinder().Radius(), 0);
    case GeomAbs_Cone:
      return set(CadSurfaceKind::Cone, surface_.Cone().Position(), surface_.Cone().RefRadius(),
                 surface_.Cone().SemiAngle());
    case GeomAbs_Sphere:
      return set(CadSurfaceKind::Sphere, surface_.Sphere().Position(), surface_.Sphere().Radius(),
                 0);
    case GeomAbs_Torus:
      return set(CadSurfaceKind::Torus, surface_.Torus().Position(), surface_.Torus().MajorRadius(),
                 surface_.Torus().MinorRadius());
    case GeomAbs_BezierSurface:
    case GeomAbs_BSplineSurface:
      face.kind = CadSurfaceKind::Spline;
      return;
    default:
      face.kind = CadSurfaceKind::Other;
  }
}

std::optional<Vec3> ExactFace::normal(double u, double v) const {
  gp_Pnt p;
  gp_Vec du, dv;
  surface_.D1(u, v, p, du, dv);
  const Vec3 a = to_vec3(du), b = to_vec3(dv), n = cross(a, b);
  if (norm(n) <= 1e-9 * norm(a) * norm(b) || norm(n) == 0) return {};
  return is_reversed_ ? -normalized(n) : normalized(n);
}

std::optional<ExactPoint> ExactFace::project(const Vec3& p) const {
  const auto at = parameters(p);
  if (!at) return {};
  const auto n = normal((*at)[0], (*at)[1]);
  const Vec3 point = to_vec3(surface_.Value((*at)[0], (*at)[1]));
  if (!is_finite(point)) return {};
  return ExactPoint{point, n.value_or(Vec3{})};
}

std::optional<std::array<double, 2>> ExactFace::parameters(const Vec3& p) const {
  double u = 0, v = 0;
  const gp_Pnt point = to_point(p);
  switch (surface_.GetType()) {
    case GeomAbs_Plane:
      ElSLib::Parameters(surface_.Plane(), point, u, v);
      break;
    case GeomAbs_Cylinder:
      ElSLib::Parameters(surface_.Cylinder(), point, u, v);
      break;
    case GeomAbs_Cone:
      ElSLib::Parameters(surface_.Cone(), point, u, v);
      break;
    case GeomAbs_Sphere:
      ElSLib::Parameters(surface_.Sphere(), point, u, v);
      break;
    case GeomAbs_Torus:
      ElSLib::Parameters(surface_.Torus(), point, u, v);
      break;
    default:
      return search(p);
  }
  return std::array{u, v};
}

/// The Hessian of half the squared distance where it is positive, else its first part. Parameters
/// stay within the surface's; a step that does not come nearer is halved.
std::optional<std::array<double, 2>> ExactFace::search(const Vec3& p) const {
  const SurfaceSample* start = nearest(samples_, p);
  if (!start) return {};
  double u = start->u, v = start->v, best = norm_sq(start->point - p);
  const double u0 = surface_.FirstUParameter(), u1 = surface_.LastUParameter();
  const double v0 = surface_.FirstVParameter(), v1 = surface_.LastVParameter();
  const auto into_u = [&](double x) { return surface_.IsUPeriodic() ? x : std::clamp(x, u0, u1); };
  const auto into_v = [&](double x) { return surface_.IsVPeriodic() ? x : std::clamp(x, v0, v1); };
  for (int step = 0; step < kMostSteps; ++step) {
    gp_Pnt point;
    gp_Vec du, dv, duu, dvv, duv;
    surface_.D2(u, v, point, du, dv, duu, dvv, duv);
    const Vec3 r = to_vec3(point) - p, a = to_vec3(du), b = to_vec3(dv);
    best = std::min(best, norm_sq(r));
    const double gu = dot(r, a), gv = dot(r, b);
    double huu = dot(a, a), huv = dot(a, b), hvv = dot(b, b);
    const double full_uu = huu + dot(r, to_vec3(duu)), full_uv = huv + dot(r, to_vec3(duv));
    const double full_vv = hvv + dot(r, to_vec3(dvv));
    if (full_uu > 0 && full_uu * full_vv - full_uv * full_uv > 1e-6 * huu * hvv) {
      huu = full_uu;
      huv = full_uv;
      hvv = full_vv;
    }
    const double d = huu * hvv - huv * huv;
    if (!(d > 0)) return std::array{u, v};  // a pole
    double su = -(hvv * gu - huv * gv) / d, sv = -(huu * gv - huv * gu) / d;
    bool is_nearer = false;
    for (int halving = 0; halving < 8 && !is_nearer; ++halving, su *= 0.5, sv *= 0.5) {
      const double nu = into_u(u + su), nv = into_v(v + sv);
      const bool is_tiny =
          std::abs(nu - u) <= kSmallStep * (u1 - u0) && std::abs(nv - v) <= kSmallStep * (v1 - v0);
      if (is_tiny) return std::array{u, v};
      const double now = norm_sq(to_vec3(surface_.Value(nu, nv)) - p);
      if (now >= best) continue;
      is_nearer = true;
      u = nu;
      v = nv;
      best = now;
    }
    if (!is_nearer) return std::array{u, v};
  }
  return std::array{u, v};
}

ExactEdge::ExactEdge(const TopoDS_Edge& edge, std::vector<CurveSample> samples)
    : curve_(edge), samples_(std::move(samples)) {}

/// The nearest piece of the polyline gives the parameter to start from.
std::optional<ExactPoint> ExactEdge::project(const Vec3& p) const {
  double t = samples_.front().t, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    const CurveSample &a = samples_[i - 1], &b = samples_[i];
    const Vec3 along = b.point - a.point;
    const double length_sq = norm_sq(along);
    const double s = length_sq > 0 ? std::clamp(dot(p - a.point, along) / length_sq, 0.0, 1.0) : 0;
    if (const double d = norm_sq(a.point + s * along - p); d < least) {
      least = d;
      t = a.t + s * (b.t - a.t);
    }
  }
  const double t0 = curve_.FirstParameter(), t1 = curve_.LastParameter();
  gp_Pnt point;
  gp_Vec first, second;
  for (int step = 0; step < kMostSteps; ++step) {
    curve_.D2(t, point, first, second);
    const Vec3 r = to_vec3(point) - p, d = to_vec3(first);
    const double full = norm_sq(d) + dot(r, to_vec3(second));
    const double h = full > 0.1 * norm_sq(d) ? full : norm_sq(d);
    if (!(h > 0)) break;
    const double next = std::clamp(t - dot(r, d) / h, t0, t1);
    const bool is_done = std::abs(next - t) <= kSmallStep * (t1 - t0);
    t = next;
    if (is_done) break;
  }
  curve_.D1(t, point, first);
  const Vec3 found = to_vec3(point);
  if (!is_finite(found)) return {};
  return ExactPoint{found, normalized(to_vec3(first))};
}

}  // namespace hexwright::cad
