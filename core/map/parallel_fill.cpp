#include "core/map/parallel_fill.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace nextview {
namespace {

template <class T>
void fill(std::span<T> array, T value) {
  constexpr std::size_t part = std::size_t{1} << 20;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, array.size(), part),
                    [&](const auto& range) { std::ranges::fill(array.subspan(range.begin(), range.size()), value); });
}

}  // namespace

void fill_in_parallel(std::span<std::uint8_t> array, std::uint8_t value) { fill(array, value); }
void fill_in_parallel(std::span<std::uint16_t> array, std::uint16_t value) { fill(array, value); }

}  // namespace nextview
