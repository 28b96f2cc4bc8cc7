#include "tests/benchmarks/evidence_posterior.hpp"

#include <algorithm>

namespace nextview {

std::vector<float> octomap_of(const EvidenceCase& c) {
  OccupancyMap map(c.grid, {});
  for (const Scan& scan : c.scans) map.insert(scan);
  return probabilities(map.voxels());
}

PosteriorSamplerConfig sampler_of(const EvidenceCase& c) {
  PosteriorSamplerConfig config;
  config.model.sigma = std::max(c.sensor.noise, 0.1 * c.grid.resolution);
  config.model.independence = 0.0;
  return config;
}

ReadOutRays rays_of(const EvidenceCase& c) {
  const PosteriorSamplerConfig config = sampler_of(c);
  ForwardSensorModel model;  // the lists' extent is that of its sigma, whatever the rays are worth
  model.sigma = config.model.sigma;
  return read_out_rays(RayLists(c.grid, merge_rays(measurements_of(c.scans), c.grid, config.ray_spacing), model));
}

}  // namespace nextview
