#pragma once
#include <string>

#include "core/gibbs/posterior_sampler_config.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {

/// The settings of the Gibbs map. What the sampler needs beyond them comes from the sensor and the map.
struct GibbsConfig {
  PosteriorSamplerConfig sampler;
  double sigma = 0.0;  ///< of the range [m]; 0: the sensor's noise, but at least a tenth of a voxel edge
  /// What a ray's log-likelihood counts; 0: from how dense the rays are (with_independence).
  double independence = 0.0;
  double angular_sigma = 0.0;  ///< of azimuth and altitude (model cone) [rad]; 0: half the angular pitch of the rays
  std::string attenuations = "0.05, 0.2";  ///< of the levels (model attenuation) [1 / voxel edge]
  int view_sweeps = 5;  ///< sweeps after each view of a scan, from the last view's maps on; 0: until stationary

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;
};
/// With those of the sampler and its model.
std::vector<Setting> settings(GibbsConfig& config);

/// `sensor_noise` [m], `ray_pitch` [rad] and `resolution` [m] stand in where a setting is 0.
PosteriorSamplerConfig posterior_sampler_config(const GibbsConfig& config, double sensor_noise, double ray_pitch,
                                                double resolution, std::uint64_t seed);

/// Angle between neighbouring pixels [rad].
double ray_pitch(const DepthCameraConfig& sensor);

}  // namespace nextview
