#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/sensor_model_calibration.hpp"
#include "core/evaluation/map_quality.hpp"
#include "core/offline/refinement.hpp"

namespace nextview {

/// Scans of an object: what the conventional map is fitted to, or, held out, tried on.
struct CalibrationExample {
  RefinementJob job;
  bool held_out = false;
};

/// Agreement of the conventional map with the Gibbs map, by what the conventional map says: the occupied share of a bin
/// is the Gibbs map's mean.
using GibbsReliability = std::array<ReliabilityBin, 10>;

/// The conventional map of one example, made with the sensor model from before and from after. Voxels: those near the
/// surface, as far as the Gibbs map knows it.
struct ExampleScores {
  std::string name;
  std::size_t views = 0;
  bool held_out = false;
  std::size_t voxels = 0;
  std::optional<double> cross_entropy_before,
      cross_entropy_after;                        ///< to the Gibbs map [nats per voxel]; of no voxels none
  std::optional<double> gibbs_entropy;            ///< of the Gibbs map itself: no map has less [nats per voxel]
  std::optional<MapScores> before, after, gibbs;  ///< against the true surface, if it is known
  GibbsReliability reliability_before, reliability_after;
  bool gibbs_stationary = false;
};

struct MapCalibrationConfig {
  CalibrationConfig fit;
  /// Voxels at most this far from one that the Gibbs map calls occupied (Chebyshev) [voxels]; 0: all. Of these, those
  /// that both maps know. Near the surface the map is decided; free space would drown it.
  int band = band_width;
};

/// What a calibration found.
struct MapCalibration {
  MapCalibrationConfig config;
  InverseSensorModel before;
  Calibration fit;
  std::vector<ExampleScores> examples;
};

/// Samples the Gibbs map of each example, fits the inverse sensor model of the conventional map to those that are not
/// held out (`calibrate`), starting from the first example's, and scores all of them before and after.
/// @throws std::invalid_argument if there is nothing to fit to, or voxel edges differ; Stopped.
MapCalibration calibrate_map(std::vector<CalibrationExample> examples, const MapCalibrationConfig& config,
                             const Progress& progress = {}, std::stop_token stop = {});

}  // namespace nextview
