#include "core/gibbs/gibbs_posterior.hpp"

#include <tbb/parallel_for.h>

namespace nextview {

std::vector<Voxel> GibbsPosterior::voxels_of(std::span<const float> p, const InverseSensorModel& classes) const {
  std::vector<Voxel> voxels(p.size());
  tbb::parallel_for(std::size_t{0}, voxels.size(), [&](std::size_t v) {
    voxels[v].probability = p[v];
    voxels[v].entropy = static_cast<float>(entropy(p[v]));
    voxels[v].voxel_class = classes.classify(p[v]);
    voxels[v].measured = informed[v];
  });
  return voxels;
}

}  // namespace nextview
