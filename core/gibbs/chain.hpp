#pragma once
#include <memory>
#include <vector>

#include "core/gibbs/posterior_sampler_config.hpp"
#include "core/gibbs/ray_lists.hpp"
#include "core/gibbs/sites.hpp"

namespace nextview {

/// What a chain adds up for the posterior mean: Rao-Blackwellised, that is the conditional probabilities themselves and
/// not the levels drawn from them.
struct PosteriorSums {
  std::vector<double> occupied, upper;  ///< sums of P(level > 0) and P(uppermost level), per voxel
  std::vector<float> reach;             ///< measured rays that get there, see SurvivalState::add_reach
  int near_sweeps = 0;                  ///< sweeps that voxels near a hit have had
  int front_sweeps = 0;                 ///< ... and those in front only: every sixteenth, as they hardly change
  int reach_samples = 0;
};

/// One Markov chain over maps. Every random number depends on the seed, the chain's index, the sweep and the voxel
/// alone.
class Chain {
 public:
  virtual ~Chain() = default;
  /// Comes before all else.
  virtual void start(std::vector<std::uint8_t> map) = 0;
  /// Updates every site once, then makes the configured moves. Returns how many voxels changed.
  virtual std::size_t sweep(PosteriorSums* mean) = 0;
  /// Adds what the present map says of who reaches whom.
  virtual void add_reach(PosteriorSums& mean, float enough) const = 0;
  /// log p(m | z) of the present map, up to a constant.
  virtual double log_posterior() const = 0;
  virtual std::span<const std::uint8_t> map() const = 0;
  virtual std::size_t bytes() const = 0;
};

std::unique_ptr<Chain> make_chain(const RayLists& lists, const PosteriorSamplerConfig& config, const Sites& sites,
                                  int index);

}  // namespace nextview
