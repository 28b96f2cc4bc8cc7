#include "core/random/counter_random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace nextview {

std::array<double, 4> CounterRandom::uniform(std::uint64_t counter) const {
  const r123::Philox4x32::ctr_type position = {
      {static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32), index_, stream_}};
  const r123::Philox4x32::key_type key = {{static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
  const auto bits = r123::Philox4x32{}(position, key);
  std::array<double, 4> values;
  for (std::size_t i = 0; i < 4; ++i) values[i] = (bits[i] + 0.5) * 0x1p-32;
  return values;
}

std::array<double, 2> CounterRandom::normal(std::uint64_t counter) const {
  const auto u = uniform(counter);
  const double radius = std::sqrt(-2.0 * std::log(u[0]));
  const double angle = 2.0 * std::numbers::pi * u[1];
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace nextview
