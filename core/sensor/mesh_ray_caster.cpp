#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/progress/stopped.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

constexpr std::size_t packet_size = 16;

void check(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(fmt::format("ray scene: {} failed{}", what,
                                       error == RTC_ERROR_OUT_OF_MEMORY
                                           ? ": the mesh needs more memory than there is"
                                           : fmt::format(" (Embree error {})", int(error))));
}

}  // namespace

struct MeshRayCaster::Impl {
  explicit Impl(const TriangleMesh& source) : mesh(source), device(rtcNewDevice(nullptr)) {}
  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void build(const std::stop_token& stop) {
    check(device, "starting Embree");
    scene = rtcNewScene(device);
    // Without `robust`, rays may slip between two triangles along the edge that they share.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    if (!mesh.triangles.empty()) attach_triangles();
    const auto go_on = [](void* asked, double) {
      return !static_cast<const std::stop_token*>(asked)->stop_requested();
    };
    rtcSetSceneProgressMonitorFunction(scene, go_on, const_cast<std::stop_token*>(&stop));
    // One thread builds: where a ray meets two triangles at the same range, the order in the tree decides between them.
    tbb::task_arena(1).execute([&] { rtcCommitScene(scene); });
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    throw_if_stopped(stop);
    check(device, "building the tree over the triangles");
  }

  void attach_triangles() {
    mesh.vertices.reserve(mesh.vertices.size() + 1);  // Embree reads 16 bytes at each vertex, so also past the last.
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
                               sizeof(mesh.vertices[0]), mesh.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(mesh.triangles[0]), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  Hit hit(const Vector3& origin, const Eigen::Vector3f& direction, std::uint32_t triangle, float range) const;

  TriangleMesh mesh;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

/// Embree finds the triangle, and its range differs in the last digits between processors (fused multiply-add); this
/// one does not.
MeshRayCaster::Hit MeshRayCaster::Impl::hit(const Vector3& origin, const Eigen::Vector3f& direction,
                                            std::uint32_t triangle, float range) const {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3 corner = mesh.vertices[a].cast<double>(), d = direction.cast<double>();
  const Vector3 normal = (mesh.vertices[b].cast<double>() - corner).cross(mesh.vertices[c].cast<double>() - corner);
  const double towards = normal.dot(d), length = normal.norm();
  const double cosine = length > 0.0 ? std::abs(towards) / length : 0.0;
  // Seen edge-on, a plane's range says little; Embree's then lies within the triangle at least.
  if (cosine < 1e-3) return {range, static_cast<float>(cosine), triangle};
  const double plane_range = normal.dot(corner - origin) / towards;
  return {static_cast<float>(plane_range), static_cast<float>(std::min(cosine, 1.0)), triangle};
}

MeshRayCaster::MeshRayCaster(const TriangleMesh& mesh, const std::stop_token& stop)
    : impl_(std::make_unique<Impl>(mesh)) {
  impl_->build(stop);
}
MeshRayCaster::~MeshRayCaster() = default;
MeshRayCaster::MeshRayCaster(MeshRayCaster&&) noexcept = default;
MeshRayCaster& MeshRayCaster::operator=(MeshRayCaster&&) noexcept = default;

void MeshRayCaster::cast(const Vector3& origin, std::span<const Eigen::Vector3f> directions, float max_range,
                         std::span<Hit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const Eigen::Vector3f o = origin.cast<float>();
  constexpr float farthest = 1e18f;  // [m] Embree's assertions let pass little more
  if (!o.allFinite() || o.cwiseAbs().maxCoeff() > farthest) {
    std::ranges::fill(hits, Hit{});
    return;
  }
  for (std::size_t first = 0; first < directions.size(); first += packet_size) {
    const std::size_t count = std::min(packet_size, directions.size() - first);
    alignas(64) int active[packet_size];
    alignas(64) RTCRayHit16 packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
      const Eigen::Vector3f& d = directions[first + std::min(i, count - 1)];
      active[i] = i < count ? -1 : 0;
      packet.ray.org_x[i] = o.x(), packet.ray.org_y[i] = o.y(), packet.ray.org_z[i] = o.z();
      packet.ray.dir_x[i] = d.x(), packet.ray.dir_y[i] = d.y(), packet.ray.dir_z[i] = d.z();
      packet.ray.tnear[i] = 0.0f, packet.ray.tfar[i] = max_range, packet.ray.time[i] = 0.0f;
      packet.ray.mask[i] = ~0u, packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(active, impl_->scene, &context, &packet);
    for (std::size_t i = 0; i < count; ++i)
      hits[first + i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                            ? Hit{}
                            : impl_->hit(origin, directions[first + i], packet.hit.primID[i], packet.ray.tfar[i]);
  }
}

}  // namespace nextview
