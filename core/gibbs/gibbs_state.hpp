#pragma once
#include <memory>
#include <mutex>
#include <stop_token>

#include "core/gibbs/independence.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// The Gibbs map of a scan that is under way: it grows view by view, and each refinement starts from the last one's
/// maps. A value: a copy shares what is large, which never changes once it is made; but for the lists of rays, which
/// are whoever's that refines first.
class GibbsState {
 public:
  GibbsState(const VoxelGrid& grid, const PosteriorSamplerConfig& config, const InverseSensorModel& classes);

  /// Adds a view's rays, merged at once: only what the voxels can tell apart is kept. All views have the maximum range
  /// of the first.
  void add(const Scan& scan);
  /// Samples the posterior of all views so far. `sweeps` as GibbsConfig::view_sweeps: if views were added since the
  /// last refinement, so many sweeps are of what they may change (WarmStart::kept). `conventional` is the map that the
  /// first refinement may start from; null: there is none. After a requested stop it holds the posterior as far as it
  /// was sampled, which says so, and can be refined on. @throws Stopped before the first sweep, and what `progress`
  /// throws; then it is as it was.
  void refine(const VoxelBricks* conventional, int sweeps, const SamplerProgress& progress, std::stop_token stop);

  /// Unmeasured before the first refinement.
  const VoxelBricks& voxels() const { return voxels_; }
  const GibbsPosterior& posterior() const { return *posterior_; }
  std::shared_ptr<const GibbsPosterior> shared_posterior() const { return posterior_; }
  /// The rays of all views so far, merged.
  const RangeMeasurements& measurements() const { return *measurements_; }
  std::shared_ptr<const RangeMeasurements> shared_measurements() const { return measurements_; }
  const PosteriorSamplerConfig& config() const { return config_; }
  /// Frees the lists of rays that are kept for the next view: the next refinement lists all of them.
  void forget_lists() const;
  /// What its maps take that another of the same scan, if given, does not share [bytes].
  std::size_t bytes(const GibbsState* other = nullptr) const;
  /// Whether the posteriors of refinements to come keep their traces.
  void keep_traces(bool keep) { config_.keep_traces = keep; }

 private:
  /// Of a scan's latest refinement: the next one adds its view's rays. One for all copies, as it takes much memory.
  struct LatestLists {
    std::mutex mutex;
    std::shared_ptr<const RangeMeasurements> measurements;  ///< that they are of
    std::unique_ptr<RayLists> lists;
  };
  std::unique_ptr<RayLists> take_lists(const ForwardSensorModel& model, const std::stop_token& stop) const;

  PosteriorSamplerConfig config_;
  InverseSensorModel classes_;
  std::size_t measured_rays_ = 0;
  HitCells hits_;  ///< of all views, if the independence follows from them
  std::uint64_t refinements_ = 0;
  std::shared_ptr<const RangeMeasurements> measurements_;
  std::shared_ptr<const RangeMeasurements> refined_;  ///< those that the posterior knows
  std::shared_ptr<LatestLists> latest_lists_;
  std::shared_ptr<const GibbsPosterior> posterior_;
  VoxelBricks voxels_;
};

/// The posterior as an occupancy map, to be saved as an octree: log-odds where informed, unmeasured elsewhere. Kept off
/// 0 and 1 by 1e-6.
OccupancyMap to_occupancy_map(const GibbsPosterior& posterior, const InverseSensorModel& classes);

}  // namespace nextview
