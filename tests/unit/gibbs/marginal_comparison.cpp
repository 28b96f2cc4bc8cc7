#include "tests/unit/gibbs/marginal_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

/// Adds one marginal of one voxel to the comparison.
void add_marginal(const std::vector<double>& values, double expected, const std::string& what,
                  MarginalComparison& result) {
  if (values.size() < 2) return;  // the voxel is wrongly taken for not informed, and said to be
  const auto count = static_cast<double>(values.size());
  double mean = 0.0, variance = 0.0;
  for (const double value : values) mean += value / count;
  for (const double value : values) variance += (value - mean) * (value - mean) / (count - 1.0);
  result.standard_error = std::max(result.standard_error, std::sqrt(variance / count));
  const double difference = std::isnan(mean) ? HUGE_VAL : std::abs(mean - expected);
  if (difference <= result.largest_difference) return;
  result.largest_difference = difference;
  result.where = fmt::format("{} {:.4f}, not {:.4f}", what, mean, expected);
}

}  // namespace

Estimate report(const plain::Marginals& marginals) {
  Estimate estimate{marginals.occupied, marginals.upper, {}};
  for (std::size_t voxel = 0; voxel < marginals.reach.size(); ++voxel) {
    estimate.informed.push_back(marginals.reach[voxel] >= 0.5);
    if (!estimate.informed[voxel]) estimate.occupied[voxel] = estimate.upper[voxel] = 0.5;
  }
  return estimate;
}

std::string MarginalComparison::text() const {
  return fmt::format("largest difference {:.4f} ({}), standard error {:.4f}{}", largest_difference, where,
                     standard_error, wrongly_informed.empty() ? "" : "; wrongly informed or not:" + wrongly_informed);
}

MarginalComparison compare(const plain::Marginals& exact, const std::vector<Estimate>& runs) {
  MarginalComparison result;
  for (std::size_t voxel = 0; voxel < exact.occupied.size(); ++voxel) {
    if (std::abs(exact.reach[voxel] - 0.5) < 0.05) continue;
    const bool informed = exact.reach[voxel] > 0.5;
    std::vector<double> occupied, upper;
    for (const Estimate& run : runs) {
      if (run.informed[voxel] != informed) continue;
      occupied.push_back(run.occupied[voxel]);
      upper.push_back(run.upper[voxel]);
    }
    const std::size_t wrong = runs.size() - occupied.size();
    if (2 * wrong > runs.size() || (wrong > 0 && std::abs(exact.reach[voxel] - 0.5) > 0.15))
      result.wrongly_informed += fmt::format(" voxel {} in {} of {} runs ({:.3f} rays reach it)", voxel, wrong,
                                             runs.size(), exact.reach[voxel]);
    add_marginal(occupied, informed ? exact.occupied[voxel] : 0.5, fmt::format("voxel {} occupied", voxel), result);
    add_marginal(upper, informed ? exact.upper[voxel] : 0.5, fmt::format("voxel {} at the upper level", voxel), result);
  }
  return result;
}

}  // namespace nextview
