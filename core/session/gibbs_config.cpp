#include "core/session/gibbs_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace nextview {
namespace {

std::vector<double> parse_attenuations(const std::string& text) {
  std::vector<double> values;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    char* end = nullptr;
    const double value = std::strtod(part.c_str(), &end);
    if (end == part.c_str() || end != part.c_str() + part.size())
      throw std::invalid_argument(fmt::format("gibbs.attenuations takes numbers with commas, not '{}'", text));
    values.push_back(value);
  }
  return values;
}

}  // namespace

void GibbsConfig::validate() const {
  const auto not_negative = [](const char* key, double value) {
    if (!(value >= 0.0 && value <= 1e3))
      throw std::invalid_argument(fmt::format("gibbs.{} must be from 0 to 1000, not {}", key, value));
  };
  not_negative("sigma", sigma);
  not_negative("angular_sigma", angular_sigma);
  if (view_sweeps != 0 && (view_sweeps < 4 || view_sweeps > 1'000'000))
    throw std::invalid_argument(fmt::format("gibbs.view_sweeps must be 0 or from 4 to 1000000, not {}", view_sweeps));
  posterior_sampler_config(*this, 0.001, 0.001, 0.01, 0).validate();
}

PosteriorSamplerConfig posterior_sampler_config(const GibbsConfig& config, double sensor_noise, double ray_pitch,
                                                double resolution, std::uint64_t seed) {
  PosteriorSamplerConfig sampler = config.sampler;
  sampler.seed = seed;
  sampler.model.attenuations = parse_attenuations(config.attenuations);
  // Ranges much finer than a voxel say no more than the voxel; a sigma of nothing would say too much.
  sampler.model.sigma = config.sigma > 0.0 ? config.sigma : std::max(sensor_noise, 0.1 * resolution);
  sampler.model.angular_sigma = config.angular_sigma > 0.0 ? config.angular_sigma : 0.5 * ray_pitch;
  return sampler;
}

double ray_pitch(const DepthCameraConfig& sensor) {
  return sensor.field_of_view * std::numbers::pi / 180.0 / sensor.width;
}

}  // namespace nextview
