#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "core/gibbs/sampler_diagnostics.hpp"

/// The diagnostics once more, from their textbook definitions. Nothing is shared with the code under test.
namespace nextview::plain {

using Series = std::vector<double>;

inline double mean(const Series& x) { return std::accumulate(x.begin(), x.end(), 0.0) / double(x.size()); }

inline Series part(const Series& x, std::size_t begin, std::size_t end) {
  return Series(x.begin() + std::ptrdiff_t(begin), x.begin() + std::ptrdiff_t(end));
}

/// Gelman et al. (2013), 11.4, of half chains: sqrt(var+ / W), var+ = (n-1)/n W + B/n.
inline double split_r_hat(const std::vector<Series>& chains) {
  std::vector<Series> halves;
  for (const Series& c : chains) {
    halves.push_back(part(c, 0, c.size() / 2));
    halves.push_back(part(c, c.size() - c.size() / 2, c.size()));
  }
  const double n = double(halves[0].size()), m = double(halves.size());
  Series means;
  double within = 0.0, between = 0.0;
  for (const Series& h : halves) {
    means.push_back(mean(h));
    for (const double v : h) within += (v - means.back()) * (v - means.back()) / (n - 1.0) / m;
  }
  for (const double v : means) between += n / (m - 1.0) * (v - mean(means)) * (v - mean(means));
  return std::sqrt(((n - 1.0) / n * within + between / n) / within);
}

/// Variance of the mean of a stationary series: its spectral density at frequency 0 over its length, by Bartlett's
/// window of `lags` lags.
inline double variance_of_mean(const Series& x, std::size_t lags) {
  const double m = mean(x), n = double(x.size());
  double density = 0.0;
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    double covariance = 0.0;
    for (std::size_t i = 0; i + lag < x.size(); ++i) covariance += (x[i] - m) * (x[i + lag] - m) / n;
    density += (lag == 0 ? 1.0 : 2.0) * (1.0 - double(lag) / double(lags + 1)) * covariance;
  }
  return density / n;
}

/// Geweke (1992): means of the first tenth and the last half, over the square root of the sum of their variances.
inline double geweke(const Series& x, std::size_t lags) {
  const Series head = part(x, 0, x.size() / 10), tail = part(x, x.size() - x.size() / 2, x.size());
  return (mean(head) - mean(tail)) / std::sqrt(variance_of_mean(head, lags) + variance_of_mean(tail, lags));
}

/// The sweeps of the mean, a series a chain.
inline std::vector<Series> of_the_mean(const SamplerDiagnostics& d) {
  std::vector<Series> chains;
  for (const Series& trace : d.log_posterior) chains.push_back(part(trace, std::size_t(d.burn_in), trace.size()));
  return chains;
}

}  // namespace nextview::plain
