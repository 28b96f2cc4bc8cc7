#pragma once
#include <stop_token>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

class UniformBricks;

/// Ways of adding a scan to a map, to the same effect: by way of a local map of its own, as the paper does, or not.
enum class Insertion { local_octree, direct };

/// The conventional occupancy map inside a region of interest: every voxel has log-odds of its own (two independence
/// assumptions). A mirror of OctoMap's tree: same values to the bit, 20 times faster. A value whose copies share what
/// they have in common (VoxelBricks). Files are OctoMap's own (octree_file.hpp).
class OccupancyMap {
 public:
  /// How much memory a map takes that is measured everywhere [bytes].
  static std::uint64_t bytes(const VoxelGrid& grid);

  /// @throws std::invalid_argument if the model is not valid; OutOfMemory if so many voxels do not fit.
  explicit OccupancyMap(const VoxelGrid& grid, const InverseSensorModel& model = {});
  OccupancyMap();  ///< of no voxels

  /// Updates each voxel at most once: a hit where a ray ends, a miss where a ray passes and none ends (as OctoMap's
  /// insertPointCloud). Rays longer than the scan's maximum range carve up to it and end nowhere; misses carve only. If
  /// the model depends on the range, it is that from the scan's origin to the voxel's centre.
  /// @throws Stopped; then, as after any other exception, the map is as it was.
  void insert(const Scan& scan, const std::stop_token& stop = {});
  void insert(const Scan& scan, Insertion insertion, const std::stop_token& stop);

  /// Adds a local map, made of one scan from `origin` [m, world], to this one: the paper's registration of local
  /// octrees. Gives the same map as inserting the scan.
  /// @throws std::invalid_argument if grid or sensor model differ.
  void register_local(const OccupancyMap& local, const Vector3& origin);

  /// From each return a traversal runs `distance` [m] farther along its ray; voxels it meets unmeasured learn how far
  /// behind a surface they are: the smallest number of steps wins. Proximity count and area factor need it, nothing
  /// else does.
  /// @throws Stopped; then, as after any other exception, the map is as it was.
  void mark_occlusions(const Scan& scan, double distance, const std::stop_token& stop = {});

  /// Sets one voxel, measured, as loading does.
  void set_log_odds(std::uint32_t voxel, float log_odds);

  /// The voxels, to be read from a file.
  std::span<CopyOnWrite<VoxelBricks::Brick>> change_bricks() { return voxels_.change_bricks(); }

  const VoxelGrid& grid() const { return grid_; }
  const InverseSensorModel& model() const { return model_; }
  const VoxelBricks& voxels() const { return voxels_; }
  float log_odds(std::size_t voxel) const { return voxels_[voxel].log_odds; }  ///< 0 where unmeasured

 private:
  VoxelClass class_of(float log_odds) const;
  template <class TouchesOf>
  void add(TouchesOf touches_of, const Vector3& origin);
  template <class TouchesOf, class Term>
  void add_terms(TouchesOf touches_of, Term term);
  template <class LogOddsAfter>
  void touch_brick(CopyOnWrite<VoxelBricks::Brick>& brick, std::span<const std::uint8_t> touches,
                   LogOddsAfter log_odds_after, UniformBricks& uniform) const;

  VoxelGrid grid_;
  InverseSensorModel model_;
  VoxelBricks voxels_;
};

}  // namespace nextview
