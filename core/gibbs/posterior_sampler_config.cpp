#include "core/gibbs/posterior_sampler_config.hpp"

namespace nextview {

std::vector<Setting> settings(PosteriorSamplerConfig& c) {
  return {
      {"gibbs.prior", "", "of a voxel being occupied (at any level but free)", &c.prior, between(0, 1)},
      {"gibbs.sampler", "", "draw from the full conditional, or Algorithm 1 as printed",
       choice(c.sampler, {"exact", "algorithm1"})},
      {"gibbs.updated", "", "voxels that are updated", choice(c.updated, {"occupied-and-free", "occupied"})},
      {"gibbs.start", "", "map that the chains start from", choice(c.start, {"octree", "free", "occupied", "random"})},
      {"gibbs.swaps", "", "passes of neighbour swaps per sweep; -1: none with attenuation, else 1", &c.swaps,
       from_to(-1, 15)},
      {"gibbs.plaquettes", "", "passes of 2 x 2 plaquettes per sweep", &c.plaquettes, from_to(0, 15)},
      {"gibbs.chains", "", "independent chains, a thread each", &c.chains, from_to(1, 64)},
      {"gibbs.sweeps", "", "sweeps of each chain, at most", &c.sweeps, from_to(4, 1e6)},
      {"gibbs.burn_in", "", "sweeps before the first mean that is tried", &c.burn_in, from_to(0, 1e6)},
      {"gibbs.until_stationary", "", "stop as soon as the chains are stationary", &c.until_stationary},
      {"gibbs.read_out", "", "probabilities: as learned from made-up parts, or of the levels as they are",
       choice(c.read_out, {"fitted", "levels"})},
      {"gibbs.ray_spacing", "", "rays nearer to each other than this are merged [voxel edges]; 0: none", &c.ray_spacing,
       from_to(0, 100)},
  };
}

void PosteriorSamplerConfig::validate() const {
  model.validate();
  require_in_bounds(*this);
}

}  // namespace nextview
