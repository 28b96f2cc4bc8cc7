#include "tests/benchmarks/planning_step_peers.hpp"

#include <embree3/rtcore.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/Ray.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>

namespace nextview {

OctomapStep::OctomapStep(const PlanningStep& step)
    : tree_(step.map.grid().resolution), discretised_tree_(step.map.grid().resolution) {
  for (int v = 0; v < PlanningStepSize{}.views_before; ++v)
    for (const bool discretised : {false, true}) insert(step.sense(9 * v), discretised);
}

void OctomapStep::insert(const Scan& scan, bool discretised) {
  octomap::OcTree& into = discretised ? discretised_tree_ : tree_;
  octomap::Pointcloud cloud;
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  for (const auto& p : scan.hits) cloud.push_back(p.x(), p.y(), p.z());
  for (const auto& p : scan.misses) {  // a little beyond the range, so that they carve and do not hit
    const Eigen::Vector3f q = origin + 1.01f * (p - origin);
    cloud.push_back(q.x(), q.y(), q.z());
  }
  into.insertPointCloud(cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), scan.max_range, discretised,
                        discretised);
  if (discretised) into.updateInnerOccupancy();
}

double OctomapStep::score(const PlanningStep& step) const {
  double best = 0.0;
  octomap::KeyRay keys;
  for (const Pose& view : step.candidates) {
    const Eigen::Vector3f o = view.translation().cast<float>();
    const octomap::point3d origin(o.x(), o.y(), o.z());
    double sum = 0.0;
    for (const Vector3& direction : step.bundle.directions) {
      const Eigen::Vector3f d = (view.linear() * direction).cast<float>();
      const octomap::point3d along(d.x(), d.y(), d.z());
      octomap::point3d end;
      if (!tree_.castRay(origin, along, end, true, PlanningStep::max_range))
        end = origin + along * static_cast<float>(PlanningStep::max_range);
      tree_.computeRayKeys(origin, end, keys);
      double visibility = 1.0;
      for (const octomap::OcTreeKey& key : keys) {
        const octomap::OcTreeNode* node = tree_.search(key);
        const double p = node ? node->getOccupancy() : 0.5;
        sum += visibility * entropy(p);
        visibility *= 1.0 - p;
      }
    }
    best = std::max(best, sum);
  }
  return best;
}

struct NanoVdbMap::Grid {
  nanovdb::GridHandle<> handle;
  double resolution;
};

NanoVdbMap::NanoVdbMap(const OccupancyMap& map) : grid_(std::make_unique<Grid>()) {
  nanovdb::GridBuilder<float> builder(0.5f);  // what nobody has measured
  auto accessor = builder.getAccessor();
  const VoxelGrid& grid = map.grid();
  std::uint32_t index = 0;
  for (const Voxel& voxel : map.voxels()) {
    const Eigen::Vector3i cell = grid.cell(index++) + grid.first;
    if (voxel.measured) accessor.setValue(nanovdb::Coord(cell.x(), cell.y(), cell.z()), voxel.probability);
  }
  grid_->handle = builder.getHandle<>();
  grid_->resolution = grid.resolution;
}

NanoVdbMap::~NanoVdbMap() = default;

double NanoVdbMap::score(const PlanningStep& step) const {
  using Ray = nanovdb::Ray<double>;
  const nanovdb::NanoGrid<float>& grid = *grid_->handle.grid<float>();
  const double reach = PlanningStep::max_range / grid_->resolution;
  const auto score_view = [&](const Pose& view) {
    const auto accessor = grid.tree().getAccessor();
    const Vector3 o = view.translation() / grid_->resolution;
    double sum = 0.0;
    for (const Vector3& direction : step.bundle.directions) {
      const Vector3 d = view.linear() * direction;
      const Ray ray({o.x(), o.y(), o.z()}, {d.x(), d.y(), d.z()}, 0.0, reach);
      nanovdb::DDA<Ray> walk(ray);
      double visibility = 1.0;
      do {
        const double p = accessor.getValue(walk.voxel());
        sum += visibility * entropy(p);
        visibility *= 1.0 - p;
        if (p > 0.5) break;
      } while (walk.step());
    }
    return sum;
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, step.candidates.size(), 1), 0.0,
      [&](const auto& range, double best) {
        for (std::size_t v = range.begin(); v != range.end(); ++v)
          best = std::max(best, score_view(step.candidates[v]));
        return best;
      },
      [](double a, double b) { return std::max(a, b); });
}

struct SingleRays::Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

SingleRays::SingleRays(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>()) {
  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (std::size_t i = 0; i < 3 * mesh.vertices.size(); ++i) vertices[i] = mesh.vertices[i / 3][i % 3];
  auto* const corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < 3 * mesh.triangles.size(); ++i) corners[i] = unsigned(mesh.triangles[i / 3][i % 3]);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
}

SingleRays::~SingleRays() = default;

std::size_t SingleRays::cast(const Vector3& origin, std::span<const Eigen::Vector3f> directions,
                             float max_range) const {
  const Eigen::Vector3f from = origin.cast<float>();
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, directions.size(), 1024), std::size_t{0},
      [&](const auto& range, std::size_t hits) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          RTCRayHit ray{};
          ray.ray.org_x = from.x(), ray.ray.org_y = from.y(), ray.ray.org_z = from.z();
          ray.ray.dir_x = directions[i].x(), ray.ray.dir_y = directions[i].y(), ray.ray.dir_z = directions[i].z();
          ray.ray.tfar = max_range;
          ray.ray.mask = 0xffffffffu;
          ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
          rtcIntersect1(scene_->scene, &context, &ray);
          hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
      },
      std::plus<>());
}

}  // namespace nextview
