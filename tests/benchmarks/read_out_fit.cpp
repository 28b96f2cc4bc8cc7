#include "tests/benchmarks/read_out_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

constexpr int dimension = ReadOutFeatures::count;
using Weights = Eigen::Matrix<double, dimension, 1>;
using Hessian = Eigen::Matrix<double, dimension, dimension>;

/// Gradient and negative Hessian of the log likelihood, with a ridge that keeps unused and equal features in check.
struct Slopes {
  Weights gradient = Weights::Zero();
  Hessian curvature = 1e-6 * Hessian::Identity();
};

void add_slopes(const ReadOutSamples& samples, std::span<const std::uint8_t> truth, const Weights& used,
                const Weights& weights, Slopes& slopes) {
  const double share = samples.weight / static_cast<double>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Weights x = Eigen::Map<const Weights>(samples.features[i].data()).cwiseProduct(used);
    const double p = probability(weights.dot(x));
    slopes.gradient += share * (truth[i] - p) * x;
    slopes.curvature.selfadjointView<Eigen::Lower>().rankUpdate(x, share * p * (1.0 - p));
  }
}

}  // namespace

ReadOutFeatures::Vector fit_read_out(std::span<const ReadOutSamples> cases,
                                     std::vector<std::uint8_t> ReadOutSamples::*truth,
                                     const std::array<bool, ReadOutFeatures::count>& used) {
  Weights mask, weights = Weights::Zero();
  for (int k = 0; k < dimension; ++k) mask[k] = used[k];
  for (int iteration = 0; iteration < 30; ++iteration) {
    Slopes slopes;
    for (const ReadOutSamples& samples : cases) add_slopes(samples, samples.*truth, mask, weights, slopes);
    const Hessian curvature = slopes.curvature.selfadjointView<Eigen::Lower>();
    const Weights step = curvature.ldlt().solve(slopes.gradient);
    const double longest = step.cwiseAbs().maxCoeff();
    weights += step * std::min(1.0, 5.0 / longest);
    if (longest < 1e-6) break;
  }
  ReadOutFeatures::Vector result;
  Eigen::Map<Weights>(result.data()) = weights;
  return result;
}

}  // namespace nextview
