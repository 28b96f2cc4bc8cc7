#include "core/gibbs/gibbs_posterior.hpp"

#include <tbb/parallel_for.h>

namespace nextview {

Voxel GibbsPosterior::voxel_of(std::size_t voxel, float p, const InverseSensorModel& classes) const {
  Voxel said;
  if (p != said.probability) said.entropy = static_cast<float>(entropy(p));  // many are as if nothing were known
  said.probability = p;
  said.voxel_class = classes.classify(p);
  said.measured = informed[voxel];
  return said;
}

VoxelBricks GibbsPosterior::bricks(const InverseSensorModel& classes) const {
  return VoxelBricks::made_of(grid.size, [&](std::size_t v) { return voxel_of(v, touch[v], classes); });
}

std::vector<Voxel> GibbsPosterior::voxels_of(std::span<const float> p, const InverseSensorModel& classes) const {
  std::vector<Voxel> voxels(p.size());
  tbb::parallel_for(std::size_t{0}, voxels.size(), [&](std::size_t v) { voxels[v] = voxel_of(v, p[v], classes); });
  return voxels;
}

}  // namespace nextview
