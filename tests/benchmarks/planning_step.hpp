#pragma once
#include <chrono>
#include <ctime>
#include <functional>
#include <limits>

#include "core/config/configuration.hpp"
#include "core/gain/map_rays.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// How large a planning step is. By default that of the default scan, after a few views: the map is neither empty nor
/// done.
struct PlanningStepSize {
  double resolution = 0.01;  ///< [m]
  int width = 640;           ///< of the image [px]
  int candidates = 48;
  int views_before = 5;
};

/// The parts of a planning step: sense, insert, score. Its map has seen a few views.
struct PlanningStep {
  static constexpr double max_range = 1.5;  ///< [m]
  static constexpr int next_view = 20;
  static std::vector<int> views_before(int count = PlanningStepSize{}.views_before);

  Configuration configuration;
  TriangleMesh mesh = load_mesh(default_object());
  MeshRayCaster scene{mesh};
  DepthCamera camera;
  std::vector<Pose> candidates;
  RayBundle bundle;
  OccupancyMap map;
  Scan scan;
  std::size_t voxel_steps = 0;  ///< that could matter when it was last scored

  explicit PlanningStep(const PlanningStepSize& size = {});
  /// One of 48 around the object, whatever the candidates are.
  Pose view(int number) const;
  Scan sense(int view) const;
  /// Of the pixels of the camera at one of these views: unit directions.
  std::vector<Eigen::Vector3f> image_rays(int view) const;
  void insert() { map.insert(scan); }
  /// By the paper's occlusion-aware gain.
  void score();
  /// By the default gain, with all that it needs of the map.
  void score_new_surface() const;
};

/// The least of several rounds [ms].
struct LeastTime {
  double waited = std::numeric_limits<double>::infinity();
  double processor = waited;  ///< of all threads

  void keep(const std::function<void()>& work) {
    const std::clock_t processor_start = std::clock();
    const auto start = std::chrono::steady_clock::now();
    work();
    waited =
        std::min(waited, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    processor = std::min(processor, 1e3 * double(std::clock() - processor_start) / CLOCKS_PER_SEC);
  }
};

/// Prints how the time and memory of a planning step's stages grow with voxels, pixels, candidates and views.
void print_growth(int rounds);

}  // namespace nextview
