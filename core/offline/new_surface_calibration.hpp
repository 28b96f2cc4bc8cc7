#pragma once
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/calibration/new_surface_fit.hpp"
#include "core/config/configuration.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/progress/progress.hpp"

namespace nextview {

/// An object to learn from.
struct TrainingObject {
  std::string name;
  std::shared_ptr<const PlacedMesh> object;
};

struct NewSurfaceCalibrationConfig {
  int views = 10;  ///< of each object
  /// Each object is scanned at one of these, in turn. Empty: as the configuration says.
  std::vector<double> resolutions = {0.01, 0.005, 0.01};     ///< voxel edge [m]
  std::vector<int> widths = {640, 160, 320};                 ///< of the image, in the ratio of the configuration's [px]
  std::vector<double> range_noises = {0.001, 0.005, 0.002};  ///< [m]
};

struct NewSurfaceCalibration {
  NewSurfaceModel model;
  std::vector<std::string> objects;
  double found_unmeasured = 0.0, found_free = 0.0, found_occupied = 0.0;  ///< shares of what was found, by voxel
  std::size_t cells = 0;                                                  ///< of voxels with like features
};

/// Parts made up for it: training_part(0 … count - 1). @throws Stopped
std::vector<TrainingObject> training_objects(int count, std::uint64_t seed, std::stop_token stop = {});

/// Scans each object, every other view at random and the others by the gain as it is now, and fits the model to what
/// the rays of all candidate views would have found after each view. The same on any number of threads.
/// @throws std::invalid_argument if there is nothing to learn from; Stopped.
NewSurfaceCalibration calibrate_new_surface(std::span<const TrainingObject> objects, const Configuration& configuration,
                                            const NewSurfaceCalibrationConfig& config, const Progress& progress = {},
                                            std::stop_token stop = {});

}  // namespace nextview
