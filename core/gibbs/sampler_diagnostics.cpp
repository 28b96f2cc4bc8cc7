#include "core/gibbs/sampler_diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nextview {
namespace {

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// Sum of squared deviations from the mean.
double deviations(std::span<const double> x) {
  const double m = mean(x);
  double sum = 0.0;
  for (const double v : x) sum += (v - m) * (v - m);
  return sum;
}

/// Rounding makes a constant's variance a little more than nothing.
bool varies(std::span<const double> x) {
  return std::ranges::any_of(x, [&](double v) { return v != x.front(); });
}

/// Within-chain variance W and the pooled estimate of the variance (Gelman et al. 2013, 11.4).
struct Variances {
  double within = 0.0, pooled = 0.0;
};

Variances variances(std::span<const std::span<const double>> chains) {
  const double n = static_cast<double>(chains.front().size()), m = static_cast<double>(chains.size());
  Variances v;
  std::vector<double> means;
  for (const auto chain : chains) {
    if (varies(chain)) v.within += deviations(chain) / (n - 1.0) / m;
    means.push_back(varies(chain) ? mean(chain) : chain.front());
  }
  const double between_over_n = varies(means) ? deviations(means) / (m - 1.0) : 0.0;
  v.pooled = (n - 1.0) / n * v.within + between_over_n;
  return v;
}

/// Mean over the chains of the autocovariance at a lag.
double autocovariance(std::span<const std::span<const double>> chains, std::size_t lag) {
  double sum = 0.0;
  for (const auto chain : chains) {
    const double m = mean(chain);
    double c = 0.0;
    for (std::size_t i = 0; i + lag < chain.size(); ++i) c += (chain[i] - m) * (chain[i + lag] - m);
    sum += c / static_cast<double>(chain.size());
  }
  return sum / static_cast<double>(chains.size());
}

/// The quantile of the standard normal that Student's t stands for (Wallace 1959: within a
/// hundredth from four degrees of freedom on, and too small below).
double normal_quantile(double t, double degrees_of_freedom) {
  const double size = (8.0 * degrees_of_freedom + 1.0) / (8.0 * degrees_of_freedom + 3.0) *
                      std::sqrt(degrees_of_freedom * std::log1p(t * t / degrees_of_freedom));
  return std::copysign(size, t);
}

}  // namespace

double split_r_hat(std::span<const std::span<const double>> chains) {
  std::vector<std::span<const double>> halves;
  for (const auto chain : chains) {
    const std::size_t half = chain.size() / 2;
    halves.push_back(chain.first(half));
    halves.push_back(chain.last(half));
  }
  const Variances v = variances(halves);
  if (v.pooled == 0.0) return 1.0;
  return v.within == 0.0 ? std::numeric_limits<double>::infinity() : std::sqrt(v.pooled / v.within);
}

double effective_sample_size(std::span<const std::span<const double>> chains) {
  const std::size_t n = chains.front().size();
  const double total = static_cast<double>(n * chains.size());
  const Variances v = variances(chains);
  if (v.pooled == 0.0) return total;
  const auto correlation = [&](std::size_t lag) {
    const double unbiased = static_cast<double>(n) / static_cast<double>(n - 1);
    return 1.0 - (v.within - autocovariance(chains, lag) * unbiased) / v.pooled;
  };
  // Sums of pairs of lags are positive and fall; noise breaks that, and the sum ends there.
  double time = -1.0, previous = std::numeric_limits<double>::infinity();
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    const double pair = std::min(previous, correlation(lag) + correlation(lag + 1));
    if (pair <= 0.0) break;
    time += 2.0 * pair;
    previous = pair;
  }
  return std::min(total, total / std::max(time, 1.0 / total));
}

double geweke_z(std::span<const double> chain) {
  if (!varies(chain)) return 0.0;
  const auto head = chain.first(std::max<std::size_t>(2, chain.size() / 10)), tail = chain.last(chain.size() / 2);
  const auto variance_of_mean = [](std::span<const double> x) {
    const std::span<const double> one[] = {x};
    return deviations(x) / static_cast<double>(x.size() - 1) / effective_sample_size(one);
  };
  const double difference = mean(head) - mean(tail);
  // The head is short: what it varies by is better known from the tail.
  const double of_tail = variance_of_mean(tail);
  const double time = static_cast<double>(tail.size()) * of_tail;  // variance of a mean times its length
  const double variance = of_tail + std::max(variance_of_mean(head), time / static_cast<double>(head.size()));
  if (variance == 0.0)
    return difference == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), difference);
  // Few values hardly know what they vary by: of eight, 2.6 standard errors are no rare thing.
  return normal_quantile(difference / std::sqrt(variance), static_cast<double>(tail.size() - 1));
}

}  // namespace nextview
