#include "tests/benchmarks/planning_step_peers.hpp"

#include <embree3/rtcore.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridBuilder.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "tests/benchmarks/planning_step_walk.hpp"

namespace nextview {

Eigen::Vector3f beyond_range(const Scan& scan, const Eigen::Vector3f& miss) {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  return origin + 1.01f * (miss - origin);
}

std::vector<MakePeer>& peer_makers() {
  static std::vector<MakePeer> makers;
  return makers;
}

OctomapStep::OctomapStep(const PlanningStep& step)
    : tree_(step.map.grid().resolution), discretised_tree_(step.map.grid().resolution) {
  for (const int view : PlanningStep::views_before())
    for (const bool discretised : {false, true}) insert(step.sense(view), discretised);
}

void OctomapStep::insert(const Scan& scan, bool discretised) {
  octomap::OcTree& into = discretised ? discretised_tree_ : tree_;
  octomap::Pointcloud cloud;
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  for (const auto& p : scan.hits) cloud.push_back(p.x(), p.y(), p.z());
  for (const auto& p : scan.misses) {
    const Eigen::Vector3f q = beyond_range(scan, p);
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

std::size_t OctomapStep::occupied(const VoxelGrid& grid) const {
  return occupied_voxels(grid, [this] {
    const auto zero = tree_.coordToKey(0.0);
    return [this, zero](int x, int y, int z) {
      const octomap::OcTreeNode* node = tree_.search(octomap::OcTreeKey(zero + x, zero + y, zero + z));
      return node ? node->getOccupancy() : 0.5;
    };
  });
}

struct NanoVdbMap::Grid {
  nanovdb::GridHandle<> handle;
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
}

NanoVdbMap::~NanoVdbMap() = default;

double NanoVdbMap::score(const PlanningStep& step) const {
  const nanovdb::NanoGrid<float>& grid = *grid_->handle.grid<float>();
  return best_score(step, [&grid] {
    return [accessor = grid.tree().getAccessor()](int x, int y, int z) {
      return accessor.getValue(nanovdb::Coord(x, y, z));
    };
  });
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
