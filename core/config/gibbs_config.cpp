#include "core/config/gibbs_config.hpp"

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

/// Puts settings behind the one of this key.
void insert(std::vector<Setting>& settings, const std::string& behind, std::vector<Setting> more) {
  const auto place = std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return s.key == behind; });
  settings.insert(place + 1, more.begin(), more.end());
}

}  // namespace

std::vector<Setting> settings(GibbsConfig& c) {
  std::vector<Setting> all = settings(c.sampler.model);
  insert(
      all, "gibbs.voxel_range",
      {
          {"gibbs.sigma", "m", "standard deviation of ranges; 0: the sensor's noise, at least a tenth of a voxel",
           &c.sigma, from_to(0, 1000)},
          {"gibbs.angular_sigma", "rad", "model cone: of azimuth and altitude; 0: half the angular pitch of the rays",
           &c.angular_sigma, from_to(0, 1000)},
      });
  insert(all, "gibbs.eta_hit",
         {
             {"gibbs.attenuations", "", "attenuation: of each level, per voxel edge", &c.attenuations},
             {"gibbs.independence", "",
              "what each ray's log-likelihood counts; 1: rays are independent; 0: from how dense they are",
              &c.independence, from_to(0, 1)},
         });
  std::vector<Setting> sampler = settings(c.sampler);
  insert(
      sampler, "gibbs.until_stationary",
      {
          {"gibbs.view_sweeps", "", "gain gibbs: sweeps after each view, from the last view's on; 0: until stationary",
           &c.view_sweeps, zero_or(4, 1e6)},
      });
  all.insert(all.end(), sampler.begin(), sampler.end());
  return all;
}

void GibbsConfig::validate() const {
  require_in_bounds(*this);
  posterior_sampler_config(*this, 0.001, 0.001, 0.01, 0).validate();
}

PosteriorSamplerConfig posterior_sampler_config(const GibbsConfig& config, double sensor_noise, double ray_pitch,
                                                double resolution, std::uint64_t seed) {
  PosteriorSamplerConfig sampler = config.sampler;
  sampler.seed = seed;
  sampler.model.attenuations = parse_attenuations(config.attenuations);
  sampler.model.independence = config.independence;
  // Ranges much finer than a voxel say no more than the voxel; a sigma of nothing would say too much.
  sampler.model.sigma = config.sigma > 0.0 ? config.sigma : std::max(sensor_noise, 0.1 * resolution);
  sampler.model.angular_sigma = config.angular_sigma > 0.0 ? config.angular_sigma : 0.5 * ray_pitch;
  return sampler;
}

double ray_pitch(const DepthCameraConfig& sensor) {
  if (!sensor.intrinsics.empty()) return 1.0 / sensor.camera().fx;
  return sensor.field_of_view * std::numbers::pi / 180.0 / sensor.width;
}

}  // namespace nextview
