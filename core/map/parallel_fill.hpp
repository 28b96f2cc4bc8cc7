#pragma once
#include <cstdint>
#include <span>

namespace nextview {

/// Gives all of a big array the same value, on all threads: the pages that it lies in are made then.
void fill_in_parallel(std::span<std::uint8_t> array, std::uint8_t value);
void fill_in_parallel(std::span<std::uint16_t> array, std::uint16_t value);

}  // namespace nextview
