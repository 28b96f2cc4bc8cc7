#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// The numbers of an inverse sensor model that can be fitted, in the order in which gradients hold them.
enum class SensorParameter : std::uint8_t { hit, miss, clamp_min, clamp_max, hit_decay, miss_decay };
inline constexpr std::size_t sensor_parameters = 6;

/// Mean over voxels of -[g ln p + (1 - g) ln(1 - p)], g the target and p what the map holds [nats].
struct CrossEntropy {
  double value = 0.0;
  /// By the log-odds of hit, miss, clamp_min and clamp_max, and by the two decays [per 1/m]; indexed by
  /// SensorParameter. At a kink, where a sum just meets a clamp, the derivative is that of the side on which the clamp
  /// does not act.
  std::array<double, sensor_parameters> gradient{};
};

/// What scans did to some voxels, hit or miss, in order and from how far: enough to say what OccupancyMap would hold
/// after them with any inverse sensor model. With each voxel the probability that it should hold, its target. All
/// voxels weigh the same, from whatever set they come: so the cross entropy is the log loss of one voxel drawn from
/// all, and a set in which more was measured says more.
class UpdateHistories {
 public:
  /// Replays scans over a grid, as OccupancyMap::insert takes them. Kept are the voxels with mask != 0 that a scan
  /// touched. May be called again for other grids, objects and views; 4 bytes per voxel and scan that touches it.
  /// @throws std::invalid_argument if `target` or `mask` is not of the grid's size, a target of the mask is not from 0
  ///         to 1, or a scan's maximum range is not over 0; Stopped. Nothing is added then.
  void add(const VoxelGrid& grid, std::span<const Scan> scans, std::span<const float> target,
           std::span<const std::uint8_t> mask, const std::stop_token& stop = {});

  /// Adds the voxels of others behind these.
  void append(const UpdateHistories& others);

  std::size_t voxels() const { return voxels_; }

  /// Same bytes on any number of threads.
  /// @throws std::invalid_argument if there are no voxels or the model is not valid.
  CrossEntropy cross_entropy(const InverseSensorModel& model) const;

  /// What the map holds with this model, one per history: a voxel, in the order of `add` and of its grid.
  /// @throws std::invalid_argument if the model is not valid.
  std::vector<double> probabilities(const InverseSensorModel& model) const;

  /// The same voxels for models whose decays are 0: there ranges do not matter, so equal sequences of hits and misses
  /// become one history, some thousand in place of a million. Their ranges are 1 m.
  UpdateHistories without_ranges() const;

 private:
  struct History {
    std::size_t end;  ///< of its updates; they begin where those of the history before end
    double voxels;    ///< how many have it
    double occupied;  ///< sum of their targets
  };
  std::span<const float> updates(std::size_t history) const;

  std::vector<float> updates_;  ///< range of the voxel's centre [m], negative (also as -0) if a miss
  std::vector<History> histories_;
  std::size_t voxels_ = 0;
};

}  // namespace nextview
