#include "core/evaluation/accuracy.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nextview {

std::vector<double> distances(const PointCloud& cloud, const MeshDistance& surface) {
  std::vector<double> result(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) result[i] = surface(cloud[i]);
  });
  return result;
}

Accuracy summarise(std::span<const double> distances) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  if (distances.empty()) return {0, undefined, undefined, undefined};
  double sum = 0.0, squares = 0.0;
  for (const double d : distances) {
    sum += d;
    squares += d * d;
  }
  const double n = static_cast<double>(distances.size());
  std::vector<double> sorted(distances.begin(), distances.end());
  const auto rank = sorted.begin() + static_cast<std::ptrdiff_t>((95 * sorted.size() + 99) / 100 - 1);
  std::nth_element(sorted.begin(), rank, sorted.end());
  return {distances.size(), sum / n, std::sqrt(squares / n), *rank};
}

}  // namespace nextview
