#include "core/map/voxel_history.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

/// Tells quickly which rays of a camera may come near a voxel: those in a cone around it.
class NearbyRays {
 public:
  NearbyRays(const VoxelGrid& grid, std::uint32_t voxel, const Eigen::Vector3f& origin)
      : origin_(origin), to_centre_((grid.centre(voxel) - origin.cast<double>()).cast<float>()) {
    const double distance_squared = to_centre_.cast<double>().squaredNorm();
    // Half a diagonal, and how far single precision may lead the walk astray.
    const double radius = 0.5 * std::numbers::sqrt3 * grid.resolution + 1e-3 * grid.resolution +
                          1e-5 * (std::sqrt(distance_squared) + origin.norm());
    around_camera_ = distance_squared <= radius * radius;
    // The squared cosine at the cone's edge times the squared distance; what single precision makes of it taken off.
    min_squared_ = static_cast<float>((1.0 - 2e-6) * distance_squared - radius * radius);
  }

  /// Whether the straight line from the camera through `end`, and on to infinity, may touch the voxel.
  bool may_touch(const Eigen::Vector3f& end) const {
    const Eigen::Vector3f along = end - origin_;
    const float forward = along.dot(to_centre_);
    return around_camera_ || (forward > 0.0f && forward * forward >= min_squared_ * along.squaredNorm());
  }

 private:
  Eigen::Vector3f origin_, to_centre_;
  float min_squared_;
  bool around_camera_;  ///< the camera may be in the voxel
};

/// Whether the walk to `end` passes through a voxel, as OccupancyMap::insert walks.
bool passes_through(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
                    const Eigen::Vector3i& cell) {
  bool found = false;
  walk_segment(grid, origin, end, [&](int x, int y, int z) {
    found = x == cell.x() && y == cell.y() && z == cell.z();
    return !found;
  });
  return found;
}

}  // namespace

std::vector<VoxelRay> rays_through(const VoxelGrid& grid, const Scan& scan, std::uint32_t voxel) {
  const Eigen::Vector3f origin = scan.origin.cast<float>();
  const Eigen::Vector3i cell = grid.cell(voxel);
  const NearbyRays nearby(grid, voxel, origin);
  std::vector<VoxelRay> rays;
  const auto add = [&](const PointCloud& ends, bool met) {
    for (const Eigen::Vector3f& point : ends) {
      if (!nearby.may_touch(point)) continue;
      const bool in_range = ray_length(origin, point) <= scan.max_range;
      const Eigen::Vector3f end = in_range ? point : point_on_ray(origin, point, scan.max_range);
      const bool met_surface = met && in_range;
      const bool hit = met_surface && grid.cell_at(point.cast<double>()) == cell;
      if (hit || passes_through(grid, origin, end, cell)) rays.push_back({end, hit, met_surface});
    }
  };
  add(scan.hits, true);
  add(scan.misses, false);
  return rays;
}

std::vector<VoxelUpdate> voxel_history(const VoxelGrid& grid, const InverseSensorModel& model,
                                       std::span<const std::shared_ptr<const Scan>> scans, std::uint32_t voxel) {
  std::vector<VoxelUpdate> history(scans.size());
  tbb::parallel_for(std::size_t{0}, scans.size(), [&](std::size_t k) {
    for (const VoxelRay& ray : rays_through(grid, *scans[k], voxel)) ++(ray.hit ? history[k].hits : history[k].misses);
  });
  const auto lowest = static_cast<float>(log_odds(model.clamp_min));
  const auto highest = static_cast<float>(log_odds(model.clamp_max));
  float before = 0.0f;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    VoxelUpdate& update = history[k];
    update.log_odds = before;
    if (update.measured()) {
      const double range = (grid.centre(voxel) - scans[k]->origin).norm();
      const auto term = static_cast<float>(update.hits > 0 ? model.hit_term(range) : model.miss_term(range));
      update.log_odds = std::clamp(before + term, lowest, highest);
    }
    update.log_odds_change = update.log_odds - before;
    update.probability = static_cast<float>(probability(update.log_odds));
    before = update.log_odds;
  }
  return history;
}

}  // namespace nextview
