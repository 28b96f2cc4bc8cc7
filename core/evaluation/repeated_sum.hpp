#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nextview {

/// Adds `term` to `sum` so many times, each time rounded as if one by one. Between two powers of two sums lie on one
/// lattice: once one was rounded to it, all further steps are the same.
inline void add_times(double& sum, double term, std::size_t times) {
  if (!(term > 0.0) || !(sum >= 0.0)) {
    for (; times > 0; --times) sum += term;
    return;
  }
  constexpr std::uint64_t exponent = std::uint64_t{0x7ff} << 52;
  while (times > 0) {
    const double before = sum;
    sum += term, --times;
    const double power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) & exponent);
    if (times < 4 || before < power || !std::isfinite(sum)) continue;
    const double step = (sum + term) - sum;
    // One step fewer than fit below the next power: the quotient is rounded, too.
    const double fit = std::floor((2.0 * power - sum) / step) - 1.0;
    if (!(fit >= 1.0)) continue;
    const auto whole = static_cast<std::size_t>(std::min(fit, static_cast<double>(times)));
    sum += static_cast<double>(whole) * step, times -= whole;
  }
}

}  // namespace nextview
