#pragma once
#include <vector>

#include "core/evaluation/map_quality.hpp"
#include "core/evaluation/openings.hpp"
#include "core/gibbs/sampler_diagnostics.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/parts.hpp"

/// Things to draw that the Gibbs sampler made.
namespace nextview::samples {

/// A map's numbers.
struct MapNumbers {
  OpeningScore openings;       ///< of all slots and bores together
  OpeningScore shown_opening;  ///< of the one that the slice goes through
  MapQuality near_surface;     ///< touch truth, scored set `visited band`
  MapQuality centres;          ///< the same against centre truth; of a Gibbs map: P(its centre is solid)
  double entropy = 0.0;        ///< over all voxels of the region [nats]
  std::size_t measured = 0;    ///< voxels; of a Gibbs map: informed
};

/// The slotted plate, turned so that its slots lie across the voxels, seen from one side by a noisy camera with
/// outliers; the conventional map and the Gibbs map of the same scans.
struct RefinedPlate {
  static constexpr int views = 4, width = 320, height = 240;          // [px]
  static constexpr double range_noise = 0.005, outliers = 0.01;       // [m], share
  static constexpr double camera_distance = 0.9, camera_tilt = 35.0;  // [m], from the plate's normal [deg]
  static constexpr double turn_x = 17.0, turn_y = 5.0, turn_z = 8.0;  // [deg]
  static constexpr double region_edge = 0.56, resolution = 0.01;      // [m]
  static constexpr std::size_t shown_opening = 1;                     // the slot 20 mm wide

  Part part;  ///< turned; the shown opening first
  VoxelGrid grid;
  std::vector<Voxel> conventional, gibbs;
  SamplerDiagnostics diagnostics;
  MapNumbers conventional_numbers, gibbs_numbers;
};
RefinedPlate refined_plate(std::uint64_t seed = 1);

}  // namespace nextview::samples
