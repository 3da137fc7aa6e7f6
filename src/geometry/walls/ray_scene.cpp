// The library traces in floats; what it hits is taken from it, how far that is is computed again in
// doubles. Rays leave from triangles, so the first hits may be the source itself and are passed.
#include "geometry/walls/ray_scene.h"

#include <cstring>
#include <numbers>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "geometry/tree/triangle_math.h"
#include "geometry/walls/embree.h"

namespace hexwright {
namespace {

/// Hits nearer than this (unit frame) on triangles that face like the source are the source's own
/// plane, hit because floats moved the origin off it.
constexpr double kSelfHit = 1e-5;
/// Triangles that do not count are passed through so often; then the ray is lost.
constexpr int kMaxPasses = 8;
/// Where to go on after a hit that does not count: past it, but not past a wall 1e-7 behind.
constexpr float kNextHit = 1.000001f, kLeastStep = 1e-9f;

}  // namespace

struct RayScene::Impl {
  Similarity frame;
  TriMesh unit;
  IdVector<TriId, Vec3> normals;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Impl(const TriMesh& surface)
      : frame(compute_unit_frame(surface)), unit(to_unit(surface, frame)) {
    for (TriId t : unit.tris.ids()) normals.push_back(unit_normal(unit.corners(t)));
    // One builder thread: the hierarchy, and with it the choice among equal hits, stays the same.
    // (The library's own thread option would also hold back the loops that cast rays.)
    const ThreadLimit one_builder(1);
    device = rtcNewDevice(nullptr);
    if (!device)
      throw Error(
          ErrorCode::OutOfResources,
          "the ray tracer cannot start; it needs some 250 MiB of address space (ulimit -v)");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    attach_triangles();
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
      release();
      throw Error(ErrorCode::OutOfResources,
                  "not enough memory for the ray tracer; simplify the surface");
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { release(); }

  void release() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void attach_triangles() {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* xyz = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), std::max<std::size_t>(1, unit.num_verts())));
    auto* index = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), std::max<std::size_t>(1, unit.num_tris())));
    if (!xyz || !index) return;  // reported by rtcGetDeviceError
    for (const Vec3& p : unit.positions)
      for (int axis = 0; axis < 3; ++axis) *xyz++ = static_cast<float>(p[axis]);
    for (const auto& tri : unit.tris)
      for (VertId v : tri) *index++ = static_cast<unsigned>(v.value());
    rtcCommitGeometry(geometry);
    if (unit.num_tris() > 0) rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  /// Length along the ray to the plane of a triangle; the float length when the ray grazes it.
  double refined_length(TriId t, const Vec3& from, const Vec3& direction, double length) const {
    const double slope = dot(normals[t], direction);
    const double exact = dot(normals[t], unit.positions[unit.tris[t][0]] - from) / slope;
    return std::abs(exact - length) < kSelfHit ? std::max(0.0, exact) : length;
  }
};

RayScene::RayScene(const TriMesh& surface) : impl_(std::make_unique<Impl>(surface)) {}
RayScene::~RayScene() = default;
const Vec3& RayScene::normal(TriId t) const { return impl_->normals[t]; }
const TriMesh& RayScene::unit_surface() const { return impl_->unit; }
const Similarity& RayScene::frame() const { return impl_->frame; }

std::optional<RayHit> RayScene::first_wall(const Vec3& from, TriId source,
                                           const Vec3& direction) const {
  float near = 0;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(from.x);
    query.ray.org_y = static_cast<float>(from.y);
    query.ray.org_z = static_cast<float>(from.z);
    query.ray.dir_x = static_cast<float>(direction.x);
    query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tnear = near;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect_first(impl_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const TriId tri(query.hit.primID);
    const double length = static_cast<double>(query.ray.tfar);
    const Vec3& n = impl_->normals[tri];
    const bool is_self =
        tri == source || (length < kSelfHit && dot(n, impl_->normals[source]) >= 0) || n == Vec3{};
    if (!is_self)
      return RayHit{
          tri, impl_->frame.length_to_world(impl_->refined_length(tri, from, direction, length))};
    near = query.ray.tfar * kNextHit + kLeastStep;
  }
  return std::nullopt;
}

std::vector<ConeRay> spread_cone(int num_rays, double half_angle) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  const double depth = 1 - std::cos(half_angle);
  std::vector<ConeRay> rays;
  for (int i = 0; i < num_rays; ++i) {
    // Equal parts of the cap's area; the half step keeps every ray off the axis and the rim.
    const double z = 1 - depth * (i + 0.5) / num_rays;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    rays.push_back({{r * std::cos(golden * i), r * std::sin(golden * i), z}, std::acos(z)});
  }
  return rays;
}

AxisFrame::AxisFrame(const Vec3& n) : z(n) {
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  x = normalized(cross(helper, n));
  y = cross(n, x);
}

}  // namespace hexwright
