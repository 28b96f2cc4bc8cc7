#include <algorithm>
#include <cmath>

#include "ui/charts/chart.hpp"

namespace nextview {

std::vector<double> round_ticks(double low, double high, int count, bool whole) {
  if (!(high > low)) high = low + 1;
  const double rough = (high - low) / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  if (whole) step = std::max(1.0, step);
  std::vector<double> ticks;
  const double first = std::floor(low / step), last = std::ceil(high / step - 1e-9);
  for (double i = first; i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

}  // namespace nextview
