#include "core/map/grid_margin.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nextview {
namespace {

template <class Value>
void expect_margin_alone_filled(const Eigen::Vector3i& size) {
  const VoxelGrid grid{0.1, {-2, 5, 0}, size};
  constexpr std::size_t behind = 3;
  std::vector<Value> array(places_with_margin(grid) + behind, Value{1});
  fill_margin_layers(grid, array, Value{7});
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y) fill_margin_of_row(grid, y, z, array, Value{7});
  std::size_t place = 0;
  for (int z = -1; z <= size.z(); ++z)
    for (int y = -1; y <= size.y(); ++y)
      for (int x = -1; x <= size.x(); ++x, ++place) {
        ASSERT_EQ(place_with_margin(grid, x, y, z), place);
        ASSERT_EQ(array[place], grid.contains({x, y, z}) ? Value{1} : Value{7}) << x << " " << y << " " << z;
      }
  for (; place < array.size(); ++place) EXPECT_EQ(array[place], Value{7}) << "behind it";
}

TEST(GridMargin, IsFilledAndNothingElse) {
  for (const Eigen::Vector3i& size : {Eigen::Vector3i(1, 1, 1), Eigen::Vector3i(5, 3, 4), Eigen::Vector3i(2, 9, 1),
                                      Eigen::Vector3i(4, 1, 3), Eigen::Vector3i(0, 0, 0)}) {
    expect_margin_alone_filled<std::uint8_t>(size);
    expect_margin_alone_filled<std::uint16_t>(size);
    expect_margin_alone_filled<float>(size);
  }
}

}  // namespace
}  // namespace nextview
