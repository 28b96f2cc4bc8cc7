#pragma once
#include <memory>
#include <vector>

#include "core/gibbs/chain.hpp"
#include "core/gibbs/gibbs_posterior.hpp"

namespace nextview {

/// The chains of one run, what they add up for the mean, and their traces.
class ChainEnsemble {
 public:
  /// `informed_elsewhere`: how many voxels are informed beside the sites. All other arguments must outlive it.
  ChainEnsemble(const RayLists& lists, const PosteriorSamplerConfig& config, const Sites& sites,
                std::size_t informed_elsewhere, SamplerDiagnostics& diagnostics);

  /// Each chain before all else; different ones from different threads.
  void start(int chain, std::vector<std::uint8_t> levels);
  std::span<const std::uint8_t> map(int chain) const { return chains_[chain]->map(); }

  /// Starts a new mean, over the next `sweeps` sweeps or more: what was before becomes burn-in.
  void begin_mean(int sweeps);
  /// Sweeps of all chains side by side, a thread a chain.
  void sweep(bool into_mean);
  /// Fills in the diagnostics of the mean.
  void diagnose();
  /// Whether the mean's beginning was unlike its end when it was diagnosed: the start is still felt.
  bool trends() const;

  bool informed(std::size_t voxel) const;
  /// Mean over the chains of PosteriorSums::occupied or ::upper. @pre the voxel is a site
  float mean(std::size_t voxel, std::vector<double> PosteriorSums::*which) const;
  /// With PosteriorSamplerConfig::keep_traces; afterwards there are none.
  LevelTraces take_level_traces();

 private:
  float chain_mean(const PosteriorSums& sums, std::size_t voxel, std::vector<double> PosteriorSums::*which) const;
  void sweep_into_mean(int chain);
  void keep_levels(int chain);
  std::vector<float> near_means() const;
  void note_divergence(const std::vector<float>& before);
  void diagnose_voxels();
  void count_voxels();

  const PosteriorSamplerConfig& config_;
  const Sites& sites_;
  const std::size_t informed_elsewhere_;
  SamplerDiagnostics& diagnostics_;
  std::vector<std::unique_ptr<Chain>> chains_;
  std::vector<PosteriorSums> sums_;
  std::vector<std::uint32_t> traced_;                     ///< a sample of the voxels near a return
  std::vector<std::uint32_t> kept_;                       ///< those that take_level_traces() is of
  std::vector<std::vector<std::vector<double>>> traces_;  ///< [chain][traced voxel][sweep of the mean]: occupied or not
  std::vector<std::deque<std::vector<std::uint8_t>>> levels_;  ///< LevelTraces::levels
  int window_ = 1;                                             ///< sweeps that the mean was begun for
  int reach_samples_ = 2;  ///< of each chain over those: a tenth of them, fewer where expensive
};

}  // namespace nextview
