#pragma once
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <stop_token>
#include <string>

#include "core/mesh/triangle_mesh.hpp"
#include "core/sensor/depth_image.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

struct DepthCameraConfig {
  int width = 640;              ///< [px]
  int height = 480;             ///< [px]
  double field_of_view = 58.0;  ///< horizontal [deg]
  std::string intrinsics;       ///< `fx fy cx cy` [px]; empty: from field_of_view
  double min_range = 0.2;       ///< nearer surfaces give invalid pixels [m]
  double max_range = 1.5;       ///< farther surfaces are beyond range [m]
  double range_noise = 0.002;   ///< standard deviation along the ray [m]
  double dropout = 0.0;         ///< share of pixels that return nothing, at random
  /// Share of the other pixels that return a range drawn evenly between min_range and max_range, whatever they look at.
  double outliers = 0.0;
  double grazing_limit = 85.0;    ///< surfaces met at more than this from their normal give invalid pixels [deg]
  double working_distance = 0.0;  ///< that suits it, at which views are laid out [m]; 0: what suits the object
  double seconds = 4.0;           ///< that a scan takes, as planning by the second has it; not simulated

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
  /// @throws std::invalid_argument if `intrinsics` are none
  PinholeCamera camera() const;

  bool operator==(const DepthCameraConfig&) const = default;
};
/// Their bounds are declared here and nowhere else; the settings of other configurations are likewise.
std::vector<Setting> settings(DepthCameraConfig& config);

/// A mesh that rays can be shot at (an Embree scene). Safe to use from several threads at once.
class MeshRayCaster {
 public:
  /// @throws Stopped
  explicit MeshRayCaster(const TriangleMesh& mesh, const std::stop_token& stop = {});
  ~MeshRayCaster();
  MeshRayCaster(MeshRayCaster&&) noexcept;
  MeshRayCaster& operator=(MeshRayCaster&&) noexcept;

  struct Hit {
    float range = DepthImage::beyond_range;  ///< [m]; beyond_range if nothing was met
    float cosine = 1.0f;                     ///< |cos| between the ray and the surface normal
    std::uint32_t triangle = 0xffffffffu;
  };
  /// First surface along each unit direction, from one origin, within `max_range` [m]. Surfaces have two sides.
  void cast(const Vector3& origin, std::span<const Eigen::Vector3f> directions, float max_range,
            std::span<Hit> hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A simulated depth camera: Gaussian noise along the ray, dropout, outliers, range limits, grazing-incidence limit.
class DepthCamera {
 public:
  /// @throws std::invalid_argument if the configuration is not valid; Stopped
  explicit DepthCamera(const DepthCameraConfig& config, const std::stop_token& stop = {});

  const DepthCameraConfig& config() const { return config_; }
  const PinholeCamera& camera() const { return camera_; }

  /// What the camera sees from T_world_camera. `view_index` and `seed` choose the noise; each pixel draws its own.
  /// @throws Stopped
  DepthImage sense(const MeshRayCaster& scene, const Pose& T_world_camera, std::uint64_t seed, std::uint32_t view_index,
                   const std::stop_token& stop = {}) const;
  /// The same without noise, dropout, outliers and grazing limit: what a perfect camera would see. For scoring.
  /// @throws Stopped
  DepthImage sense_ideal(const MeshRayCaster& scene, const Pose& T_world_camera,
                         const std::stop_token& stop = {}) const;

 private:
  DepthCameraConfig config_;
  PinholeCamera camera_;
  std::vector<Eigen::Vector3f> directions_;  ///< unit, camera frame, row by row
};

}  // namespace nextview
