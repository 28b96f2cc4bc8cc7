#include "ui/figures/grid_slice.hpp"

#include <gtest/gtest.h>

#include "ui/figures/slice.hpp"

namespace nextview {
namespace {

constexpr double voxel_edge = 0.01;

VoxelGrid grid_of(int x, int y, int z) { return {voxel_edge, {-3, 2, 0}, {x, y, z}}; }

Voxel measured(float p) { return {p, float(entropy(p)), VoxelClass::unknown, true, 0}; }

/// The colour of the pixel `x` to the right and `y` up, as 0xRRGGBB.
std::uint32_t colour_at(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgba[(std::size_t(image.height - 1 - y) * image.width + x) * 4];
  return std::uint32_t(p[0]) << 16 | std::uint32_t(p[1]) << 8 | p[2];
}

SliceContent content_of(const VoxelGrid& grid, const GridSlice& slice, std::span<const Voxel> voxels) {
  SliceContent content;
  content.grid = grid;
  content.slice = slice;
  content.voxels = voxels;
  return content;
}

TEST(GridSlice, AnOpeningIsCutAcrossItsLength) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.64, voxel_edge);
  Opening opening;
  opening.width = 0.02;
  opening.length = 0.12;
  opening.depth = 0.03;
  opening.centre = {0.031, 0.052, -0.087};
  const Eigen::AngleAxisd turned(0.2, Vector3(1, 2, 3).normalized());
  for (int along = 0; along < 3; ++along) {
    opening.along = turned * Vector3::Unit(along);
    opening.axis = turned * Vector3::Unit((along + 1) % 3);
    const GridSlice slice = slice_across(opening, grid);
    EXPECT_EQ(slice.axis, along);
    EXPECT_EQ(slice.index, grid.cell_at(opening.centre)[along]);
    EXPECT_NO_THROW(slice.check(grid));
    // Both mouths and both walls are in it.
    const Vector3 across = opening.axis.cross(opening.along);
    for (const Vector3& place :
         {Vector3(opening.centre + 0.035 * opening.axis), Vector3(opening.centre - 0.035 * opening.axis),
          Vector3(opening.centre + 0.04 * across), Vector3(opening.centre - 0.04 * across)}) {
      const Eigen::Vector3i cell = grid.cell_at(place);
      EXPECT_GE(cell[slice.right_axis()], slice.left);
      EXPECT_LT(cell[slice.right_axis()], slice.left + slice.width);
      EXPECT_GE(cell[slice.up_axis()], slice.bottom);
      EXPECT_LT(cell[slice.up_axis()], slice.bottom + slice.height);
    }
  }
}

TEST(GridSlice, TheLargestDifferenceIsFound) {
  const VoxelGrid grid = grid_of(12, 14, 40);
  std::vector<Voxel> one(grid.voxel_count(), measured(0.1f)), other = one;
  // Most in the layer y = 9, however little in each voxel.
  for (int x = 0; x < 12; ++x)
    for (int z = 0; z < 40; ++z) other[grid.index({x, 9, z})].probability = 0.2f;
  GridSlice slice = slice_of_largest_difference(grid, one, other);
  EXPECT_EQ(slice.axis, 1);
  EXPECT_EQ(slice.index, 9);
  EXPECT_EQ(slice.width, 12) << "nothing occupied in it: all of it shows";
  EXPECT_EQ(slice.height, 40);

  // Free space does not count as soon as something is called occupied: a wall that the other map has not, in x = 4.
  for (int y = 3; y < 8; ++y) other[grid.index({4, y, 6})].probability = 0.9f;
  slice = slice_of_largest_difference(grid, one, other);
  EXPECT_EQ(slice.axis, 0);
  EXPECT_EQ(slice.index, 4);
  EXPECT_LT(slice.height, 40) << "cropped around the wall";
  // It is y from 3 to 7 and z of 6; what is free around it shows, too.
  EXPECT_TRUE(slice.left == 0 && slice.left + slice.width >= 12) << slice.left << " + " << slice.width;
  EXPECT_TRUE(slice.bottom <= 3 && slice.bottom + slice.height >= 10) << slice.bottom << " + " << slice.height;
  EXPECT_LT(slice.height, 14) << "and not much more";
  // What a map calls occupied that has not measured it does not count.
  for (int y = 3; y < 8; ++y) other[grid.index({4, y, 6})].measured = false;
  slice = slice_of_largest_difference(grid, one, other);
  EXPECT_EQ(slice.axis, 1);
}

TEST(GridSlice, ACrossSectionOfABoxIsItsRectangle) {
  const Part box = box_part();
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.64, voxel_edge);
  const Vector3 size = box.mesh.bounding_box().sizes() / voxel_edge;
  for (int axis = 0; axis < 3; ++axis) {
    const GridSlice slice = whole_layer(grid, axis, 32);
    double length = 0.0;
    for (const LinePiece& piece : cross_section(box.mesh, grid, slice)) length += (piece[1] - piece[0]).norm();
    EXPECT_NEAR(length, 2 * (size[slice.right_axis()] + size[slice.up_axis()]), 1e-3);
  }
  EXPECT_TRUE(cross_section(box.mesh, grid, whole_layer(grid, 0, 0)).empty());
}

TEST(GridSlice, RefusesWhatIsNotInTheGrid) {
  const VoxelGrid grid = grid_of(4, 5, 6);
  EXPECT_THROW(whole_layer(grid, 2, 6).check(grid), std::invalid_argument);
  EXPECT_THROW((GridSlice{2, 0, 1, 0, 4, 5}.check(grid)), std::invalid_argument);
  EXPECT_THROW((GridSlice{2, 0, 0, 0, 0, 5}.check(grid)), std::invalid_argument);
  const std::vector<Voxel> too_few(7);
  EXPECT_THROW(slice_squares(content_of(grid, whole_layer(grid, 0, 0), too_few), 4), std::invalid_argument);
}

TEST(SliceSquares, AreCrispAndInTheirPlaces) {
  const VoxelGrid grid = grid_of(3, 4, 2);
  std::vector<Voxel> voxels(grid.voxel_count(), measured(0.0f));
  voxels[grid.index({1, 2, 1})] = measured(1.0f);
  voxels[grid.index({0, 0, 1})] = {};  // not measured
  const Image image = slice_squares(content_of(grid, whole_layer(grid, 2, 1), voxels), 5);
  ASSERT_EQ(image.width, 15);
  ASSERT_EQ(image.height, 20);
  const std::uint32_t free = colour_at(image, 14, 19), occupied = colour_at(image, 7, 12);
  EXPECT_NE(free, occupied);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 15; ++x) {
      const bool in_occupied = x / 5 == 1 && y / 5 == 2, unmeasured = x / 5 == 0 && y / 5 == 0;
      if (unmeasured)
        EXPECT_NE(colour_at(image, x, y), free) << x << ", " << y;
      else
        EXPECT_EQ(colour_at(image, x, y), in_occupied ? occupied : free) << x << ", " << y;
    }
  EXPECT_NE(colour_at(image, 0, 0), colour_at(image, 1, 0)) << "hatched, not plain";
}

TEST(SliceSquares, ADifferenceIsOfNoColourWhereMapsAgree) {
  const VoxelGrid grid = grid_of(3, 1, 1);
  const std::vector<Voxel> one = {measured(0.3f), measured(0.9f), measured(0.1f)};
  const std::vector<Voxel> other = {measured(0.3f), measured(0.1f), measured(0.9f)};
  SliceContent content = content_of(grid, whole_layer(grid, 2, 0), one);
  content.value = SliceValue::difference;
  content.other = other;
  const Image difference = slice_squares(content, 2);
  // The same colours as probabilities: agreement as undecided, more occupied as occupied, freer as free.
  const std::vector<Voxel> alike = {measured(0.5f), measured(0.9f), measured(0.1f)};
  EXPECT_EQ(difference, slice_squares(content_of(grid, content.slice, alike), 2));
}

TEST(SliceSquares, ADifferenceIsHatchedWhereNeitherMapHasMeasured) {
  const VoxelGrid grid = grid_of(4, 1, 1);
  const std::vector<Voxel> one = {measured(0.3f), {}, measured(0.3f), {}};
  const std::vector<Voxel> other = {{}, measured(0.3f), measured(0.3f), {}};
  SliceContent content = content_of(grid, whole_layer(grid, 2, 0), one);
  content.value = SliceValue::difference;
  content.other = other;
  const Image image = slice_squares(content, 7);
  const auto plain = [&](int voxel) {
    for (int x = 0; x < 7; ++x)
      for (int y = 0; y < 7; ++y)
        if (colour_at(image, 7 * voxel + x, y) != colour_at(image, 7 * voxel, 0)) return false;
    return true;
  };
  EXPECT_TRUE(plain(0) && plain(1) && plain(2));
  EXPECT_FALSE(plain(3));
}

/// Of a slice's panel, which rows of a column have ink that is on no blank panel; parts that are so far from each other
/// are apart.
std::vector<std::pair<int, int>> parts_of_row(const Image& image, int bottom, int top, int gap) {
  std::vector<std::pair<int, int>> parts;
  for (int x = 20; x < image.width - 20; ++x) {  // within the panel's frame
    bool ink = false;
    for (int y = bottom; y < top; ++y) ink |= (colour_at(image, x, y) & 0xFF) < 0xF0;
    if (!ink) continue;
    if (parts.empty() || x > parts.back().second + gap) parts.emplace_back(x, x);
    parts.back().second = x;
  }
  return parts;
}

Image panel_of(const std::function<void(SliceContent&)>& change) {
  const VoxelGrid grid = grid_of(30, 12, 1);
  std::vector<Voxel> voxels(grid.voxel_count(), measured(0.1f));
  SliceContent content = content_of(grid, whole_layer(grid, 2, 0), voxels);
  change(content);
  return draw_page(620, 360, [&](vtkContext2D& context) { paint_slice(context, {0, 0, 620, 360}, content); });
}

TEST(SlicePanel, ItsLegendNamesWhatItsColoursAndHatchesAre) {
  const auto lowest = [](const Image& image) {
    for (int y = 5;; ++y)
      if (!parts_of_row(image, y, y + 1, 5).empty()) return y;
  };
  const Image usual = panel_of([](SliceContent&) {});
  const int y = lowest(usual);
  // The lower row: "0", the bar, "1", each apart from the next; no true surface is there to be named; the scale bar.
  const auto lower = parts_of_row(usual, y, y + 14, 5);
  ASSERT_EQ(lower.size(), 4u);
  EXPECT_LT(lower[0].second - lower[0].first, 12) << "a digit";
  EXPECT_NEAR(lower[1].second - lower[1].first, 130, 2) << "the bar";
  EXPECT_LT(lower[2].second - lower[2].first, 12) << "a digit";
  const TriangleMesh none;
  EXPECT_GT(parts_of_row(panel_of([&](SliceContent& c) { c.object = &none; }), y, y + 14, 5).size(), 4u);
  // The upper row: what the colours are, a hatched patch and its name, how long the bar is.
  const auto words_beside_patch = [&](const std::string& name) {
    const Image image = panel_of([&](SliceContent& content) { content.unmeasured_name = name; });
    const auto upper = parts_of_row(image, y + 22, y + 38, 12);
    EXPECT_EQ(upper.size(), 3u);
    return upper.size() > 1 ? upper[1].second - upper[1].first : 0;
  };
  EXPECT_GT(words_beside_patch("not measured"), words_beside_patch("") + 50);
  EXPECT_GT(words_beside_patch("not measured by either"), words_beside_patch("not measured") + 30);
}

TEST(SliceSquares, ReachThePageUnchanged) {
  const VoxelGrid grid = grid_of(3, 4, 1);
  std::vector<Voxel> voxels;
  for (std::size_t i = 0; i < grid.voxel_count(); ++i) voxels.push_back(measured(float(i) / 11));
  const Image squares = slice_squares(content_of(grid, whole_layer(grid, 2, 0), voxels), 9);
  const Image page = draw_page(64, 48, [&](vtkContext2D& context) { paint_image(context, 5, 7, squares); });
  for (int y = 0; y < squares.height; ++y)
    for (int x = 0; x < squares.width; ++x)
      ASSERT_EQ(colour_at(page, x + 5, y + 7), colour_at(squares, x, y)) << x << ", " << y;
}

TEST(Page, ClipsToABox) {
  const Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 4));
  LinePiece through{Eigen::Vector2d(-5, -1), Eigen::Vector2d(15, 7)};
  ASSERT_TRUE(clip(through, box));
  EXPECT_TRUE(through[0].isApprox(Eigen::Vector2d(0, 1)) && through[1].isApprox(Eigen::Vector2d(7.5, 4)));
  LinePiece beside{Eigen::Vector2d(-5, 3), Eigen::Vector2d(5, 13)};
  EXPECT_FALSE(clip(beside, box));
  LinePiece inside{Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 3)};
  const LinePiece same = inside;
  ASSERT_TRUE(clip(inside, box));
  EXPECT_EQ(inside, same);
}

}  // namespace
}  // namespace nextview
