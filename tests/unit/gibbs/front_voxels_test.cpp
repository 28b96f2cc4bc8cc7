// Voxels that rays can only have passed. Those of one ray depend on each other: which of them is drawn first must not
// be theirs to decide.
#include <gtest/gtest.h>

#include "core/gibbs/exact_posterior.hpp"
#include "core/gibbs/posterior_sampler.hpp"

namespace nextview {
namespace {

TEST(FrontVoxels, OfOneRayHaveThePosteriorOfAllMaps) {
  constexpr double edge = 0.01, max_range = 0.06;
  for (const int length : {2, 4, 8}) {
    const VoxelGrid grid{edge, Eigen::Vector3i::Zero(), {length, 1, 1}};
    const Vector3 origin(-0.005, 0.005, 0.005);
    const Vector3 end = origin + max_range * (1 + length / 8) * Vector3::UnitX();
    const RangeMeasurements beyond{(end - origin).x(), {origin}, {{end.cast<float>(), 0, 1, true}}};
    for (const ForwardModel kind : {ForwardModel::beam, ForwardModel::attenuation}) {
      PosteriorSamplerConfig config;
      config.model.kind = kind;
      config.model.sigma = 0.002;
      config.model.random_weight = 0.1;
      config.model.attenuations = {2.0};
      config.model.independence = 1.0;
      config.prior = 0.5;
      config.swaps = 0;
      config.chains = 4, config.sweeps = 80'000, config.burn_in = 100;
      config.until_stationary = false;
      config.ray_spacing = 0.0;
      const ExactPosterior exact = exact_posterior(grid, beyond, config.model, config.prior);
      const GibbsPosterior sampled = sample_posterior(grid, beyond, config);
      for (std::size_t v = 0; v < exact.occupied.size(); ++v)
        if (sampled.informed[v]) {
          EXPECT_NEAR(sampled.occupied[v], exact.occupied[v], 0.01)
              << name(kind) << ", voxel " << v << " of " << length;
        }
      EXPECT_TRUE(sampled.informed[0]);
    }
  }
}

}  // namespace
}  // namespace nextview
