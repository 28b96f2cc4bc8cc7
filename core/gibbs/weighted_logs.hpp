#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nextview {

/// Sums weight * log(factor) over many factors, eight side by side: a plain loop that compilers make vectors of. So the
/// bits are the same on every processor, and no logarithm waits for another.
class WeightedLogs {
 public:
  /// @pre the factor is greater than 0, finite and no denormal number
  void add(float factor, float weight) {
    factors_[count_] = factor;
    weights_[count_] = weight;
    if (++count_ < lanes) return;
    sum_ += sum_of(factors_, weights_);
    count_ = 0;
  }
  double sum() const {
    Lanes factors;
    factors.fill(1.0f);
    std::copy_n(factors_.begin(), count_, factors.begin());
    return sum_ + (count_ == 0 ? 0.0 : sum_of(factors, weights_));
  }

  /// Natural logarithm, to 2e-7 of itself or of 1, whichever is more. @pre as add()
  static float log(float x) {
    // x = 2^exponent m, and m lies between the roots of 1/2 and 2.
    constexpr std::uint32_t root_of_half = 0x3f3504f3, mantissa = 0x007fffff;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x) + (0x3f800000 - root_of_half);
    const auto exponent = static_cast<float>(static_cast<std::int32_t>(bits >> 23) - 127);
    const float m = std::bit_cast<float>((bits & mantissa) + root_of_half);
    const float t = (m - 1.0f) / (m + 1.0f), squared = t * t;  // log(m) = 2 artanh(t)
    const float series =
        2.0f + squared * (2.0f / 3.0f + squared * (2.0f / 5.0f + squared * (2.0f / 7.0f + squared * (2.0f / 9.0f))));
    return exponent * 0.693147181f + t * series;
  }

 private:
  static constexpr std::size_t lanes = 8;
  using Lanes = std::array<float, lanes>;

  /// Of eight.
  static float sum_of(const Lanes& factors, const Lanes& weights) {
    Lanes terms;
    for (std::size_t i = 0; i < lanes; ++i) terms[i] = weights[i] * log(factors[i]);
    for (std::size_t half = lanes / 2; half > 0; half /= 2)
      for (std::size_t i = 0; i < half; ++i) terms[i] += terms[i + half];
    return terms[0];
  }

  Lanes factors_{}, weights_{};
  std::size_t count_ = 0;
  double sum_ = 0.0;
};

}  // namespace nextview
