#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "core/gain/map_rays.hpp"
#include "core/gibbs/gibbs_state.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/map/scanned_surface.hpp"
#include "core/progress/progress.hpp"
#include "core/view/view.hpp"

namespace nextview {

/// A view that was taken.
struct TakenView {
  View wanted;
  Pose T_world_camera = Pose::Identity();  ///< the one that was reached
  double expected_new_surface = 0.0;       ///< [cm^2]; 0 if nothing was expected, or a planner had another unit
  double new_surface = 0.0;                ///< that it showed [cm^2]
};

/// All that a scan has learned, and all that a fork of it copies: a few pointers, as copies share what they have in
/// common.
struct Knowledge {
  OccupancyMap map;
  std::shared_ptr<const GibbsState> posterior = {};    ///< the Gibbs map; null if the planner needs none
  std::shared_ptr<const ReferenceMap> reference = {};  ///< reference semantics only
  std::shared_ptr<const ScannedSurface> scanned = {};  ///< null where nothing is to be scanned
  std::vector<TakenView> taken = {};

  /// The voxels that views are planned on: the Gibbs map's if there is one.
  const VoxelBricks& planning_voxels() const { return posterior ? posterior->voxels() : map.voxels(); }
  /// Which of those taken it was, from 0; none if it was not.
  std::optional<std::size_t> taken_as(const View& view) const {
    const auto same = std::ranges::find(taken, view, &TakenView::wanted);
    return same == taken.end() ? std::nullopt : std::optional(std::size_t(same - taken.begin()));
  }
  bool has_taken(const View& view) const { return taken_as(view).has_value(); }
};

/// The frames of a recording that were taken, in order; other views are passed over.
inline std::vector<std::size_t> frames_taken(const Knowledge& known) {
  std::vector<std::size_t> frames;
  for (const TakenView& view : known.taken)
    if (view.wanted.frame) frames.push_back(*view.wanted.frame);
  return frames;
}

/// How scans enter the maps.
struct FusionConfig {
  Insertion insertion = Insertion::direct;
  double occlusion_distance = 0.0;  ///< how far behind surfaces voxels are marked [m]; 0: none are
  int view_sweeps = 0;              ///< as GibbsConfig::view_sweeps
};
struct FusionSeconds {
  double insert = 0.0, refine = 0.0;
};

/// A scan enters all the maps that there are: a pure function, so that scanning, replaying and looking ahead are the
/// same. @throws Stopped; then, as after any other exception, what is known is as it was.
FusionSeconds fuse(Knowledge& known, const Scan& scan, const FusionConfig& config, const Progress& progress = {},
                   const std::stop_token& stop = {});

/// Rays of at most `ray_length` [m] through what views are planned on.
std::unique_ptr<RayCaster> planning_rays(const Knowledge& known, double ray_length);

}  // namespace nextview
