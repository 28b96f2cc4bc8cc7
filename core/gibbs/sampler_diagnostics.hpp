#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace nextview {

/// Split R-hat of several chains of equal length (Gelman et al. 2013): each chain counts as two halves. 1 if nothing
/// varies at all; infinite if the chains stand still at different places. @pre at least 4 values a chain
double split_r_hat(std::span<const std::span<const double>> chains);

/// Effective sample size of several chains together (Geyer's initial monotone sequence). As many as values if nothing
/// varies.
double effective_sample_size(std::span<const std::span<const double>> chains);

/// Geweke's statistic: the difference between the mean of the first tenth and that of the last half, in standard errors
/// that account for autocorrelation; about standard normal if there is no trend, of few values too (what would be
/// Student's t is told as the normal quantile that is as rare; of under ten values as a smaller one). 0 if nothing
/// varies. @pre at least 4 values
double geweke_z(std::span<const double> chain);

/// How a run of the sampler went.
struct SamplerDiagnostics {
  std::size_t measured_rays = 0, merged_rays = 0;  ///< before and after merging
  std::size_t observed_voxels = 0;                 ///< that are sampled: some ray may depend on them
  std::size_t informed_voxels = 0;
  std::size_t incidences = 0;  ///< pairs of ray and voxel
  std::size_t list_bytes = 0, chain_bytes = 0;

  std::vector<std::vector<double>> log_posterior;        ///< after each sweep of each chain, up to a constant
  std::vector<std::vector<std::size_t>> changed_voxels;  ///< in each sweep
  /// D_KL between the running mean after a sweep and that before it, over voxels near a return [nats]; chain 0, from
  /// the mean's second sweep on.
  std::vector<double> divergence;

  int burn_in = 0;                       ///< sweeps of each chain that are not in the mean
  int sweeps = 0;                        ///< of each chain in all
  double r_hat = 0.0;                    ///< of the log-posterior, over the mean's sweeps
  double effective_samples = 0.0;        ///< of the log-posterior
  double trend = 0.0;                    ///< largest |Geweke z| of the log-posterior of any chain
  double voxel_r_hat = 0.0;              ///< 95th percentile over a sample of undecided voxels
  double voxel_effective_samples = 0.0;  ///< 5th percentile over the same voxels
  std::size_t disagreeing_voxels = 0;    ///< informed ones whose mean differs by over 0.5 between two chains
  /// Of fewer sweeps in the mean neither R-hat nor the trend says anything.
  static constexpr int fewest_telling_sweeps = 10;
  bool few_sweeps() const { return sweeps - burn_in < fewest_telling_sweeps; }
  bool stopped = false;  ///< before its sweeps were made
  /// Whether more sweeps are all that is wanting.
  bool too_short_to_tell() const { return few_sweeps() && !stopped && merged_rays > 0; }
  bool stationary = false;
  std::string warning;  ///< for people; empty if there is nothing to warn of

  double build_seconds = 0.0, sample_seconds = 0.0;  ///< wall time; differ from run to run
};

}  // namespace nextview
