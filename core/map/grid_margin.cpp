#include "core/map/grid_margin.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace nextview {
namespace {

template <class Value>
void fill(const VoxelGrid& grid, std::span<Value> array, Value value) {
  const std::size_t row = std::size_t(grid.size.x()) + 2, layer = row * (std::size_t(grid.size.y()) + 2);
  const std::size_t last = places_with_margin(grid) - layer;
  std::ranges::fill(array.first(layer), value);
  std::ranges::fill(array.subspan(last), value);
  tbb::parallel_for(1, grid.size.z() + 1, [&](int z) {
    const std::span<Value> here = array.subspan(std::size_t(z) * layer, layer);
    std::ranges::fill(here.first(row), value);
    std::ranges::fill(here.last(row), value);
    for (std::size_t first = row; first + row < layer; first += row) here[first] = here[first + row - 1] = value;
  });
}

}  // namespace

void fill_margin(const VoxelGrid& grid, std::span<std::uint8_t> array, std::uint8_t value) { fill(grid, array, value); }
void fill_margin(const VoxelGrid& grid, std::span<std::uint16_t> array, std::uint16_t value) {
  fill(grid, array, value);
}
void fill_margin(const VoxelGrid& grid, std::span<float> array, float value) { fill(grid, array, value); }

}  // namespace nextview
