#pragma once
#include <filesystem>
#include <span>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/huge_pages.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// What some voxels of a map were before something was added to it.
struct MapChanges {
  struct Change {
    std::uint32_t voxel;
    float log_odds;
    Voxel before;
  };
  std::vector<Change> changes;  ///< of a voxel there may be several
};

/// The conventional occupancy map inside a region of interest: every voxel has log-odds of its own (two independence
/// assumptions). A dense mirror of OctoMap's tree: same values to the bit, 20 times faster. Files are OctoMap's own
/// (octree_file.hpp).
class OccupancyMap {
 public:
  /// How much memory a map takes [bytes].
  static std::uint64_t bytes(const VoxelGrid& grid);

  /// @throws std::invalid_argument if the model is not valid; OutOfMemory if so many voxels do not fit.
  OccupancyMap(const VoxelGrid& grid, const InverseSensorModel& model);

  /// Updates each voxel at most once: a hit where a return ends, a miss where a ray passes and none ends (as OctoMap's
  /// insertPointCloud). Rays longer than `max_range` [m] carve up to it and end nowhere; passes carve only. If the
  /// model depends on the range, it is that from the scan's origin to the voxel's centre. `undo`, if given, learns how
  /// to go back.
  /// @throws Stopped; then, as after any other exception, the map is as it was.
  void insert(const Scan& scan, double max_range, const std::stop_token& stop = {}, MapChanges* undo = nullptr);

  /// Adds a local map, made of one scan from `origin` [m, world], to this one: the paper's registration of local
  /// octrees. Gives the same map as inserting the scan.
  /// @throws std::invalid_argument if grid or sensor model differ.
  void register_local(const OccupancyMap& local, const Vector3& origin, MapChanges* undo = nullptr);

  /// From each return a traversal runs `distance` [m] farther along its ray; voxels it meets unmeasured learn how far
  /// behind a surface they are: the smallest number of steps wins. Proximity count and area factor need it, nothing
  /// else does.
  /// @throws Stopped; then some are marked: go back with `undo`.
  void mark_occlusions(const Scan& scan, double max_range, double distance, const std::stop_token& stop = {},
                       MapChanges* undo = nullptr);

  /// Undoes what has been added since `undo` was empty.
  void go_back(const MapChanges& undo);

  /// Sets one voxel, measured, as loading does.
  void set_log_odds(std::uint32_t voxel, float log_odds);

  const VoxelGrid& grid() const { return grid_; }
  const InverseSensorModel& model() const { return model_; }
  std::span<const Voxel> voxels() const { return voxels_; }
  std::span<const float> log_odds() const { return log_odds_; }  ///< 0 where unmeasured

 private:
  Voxel measured_voxel(float log_odds) const;
  void remember_touched(MapChanges& undo) const;
  void update_touched(const Vector3& origin);
  template <class Term>
  void add_to_touched(Term term);

  VoxelGrid grid_;
  InverseSensorModel model_;
  std::vector<float, HugePages<float>> log_odds_;
  std::vector<Voxel, HugePages<Voxel>> voxels_;
  std::vector<std::uint8_t, HugePages<std::uint8_t>> touched_;  ///< scratch of insert: 0, pass or hit
};

}  // namespace nextview
