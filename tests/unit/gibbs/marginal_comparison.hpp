#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/gibbs/plain_model.hpp"

namespace nextview {

/// One estimate as the sampler reports it.
struct Estimate {
  std::vector<double> occupied, upper;
  std::vector<std::uint8_t> informed;
};
/// Likewise of the plain sampler: 0.5 where a voxel is not informed.
Estimate report(const plain::Marginals& marginals);

/// How far estimated marginals are from exact ones.
struct MarginalComparison {
  double largest_difference = 0.0;
  std::string where;             ///< of the largest difference
  double standard_error = 0.0;   ///< of the mean of the runs, Monte Carlo alone: largest of any voxel
  std::string wrongly_informed;  ///< voxels that are taken for informed, or not, and should not; empty: none

  /// The bar.
  bool agrees() const { return largest_difference < 0.01 && wrongly_informed.empty(); }
  std::string text() const;
};

/// Compares the mean of `runs`, which share nothing, with what the exact marginals say should be reported: their own
/// probabilities where over 0.55 rays reach a voxel, 0.5 where under 0.45 do. Between the two either is right. Who is
/// informed is a Monte-Carlo estimate, too: every run must get it right beyond 0.35 and 0.65 rays, most runs before.
MarginalComparison compare(const plain::Marginals& exact, const std::vector<Estimate>& runs);

}  // namespace nextview
