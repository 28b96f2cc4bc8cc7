#include "core/map/brick_archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nextview {
namespace {

const VoxelGrid walled{0.01, {-3, 0, 8}, {64, 64, 64}};

/// Free on one side of a wall, with a mark behind it.
OccupancyMap map_with_wall() {
  OccupancyMap map(walled);
  for (std::uint32_t v = 0; v < walled.voxel_count(); ++v)
    if (const int x = walled.cell(v).x(); x <= 36) map.set_log_odds(v, x == 36 ? 0.85f : -0.4f);
  map.change_bricks().back().change().set_occlusion_distance(7, 21);
  return map;
}

std::string bytes_of(const OccupancyMap& map) {
  std::string bytes;
  ByteWriter writer([&](std::string_view more) { bytes += more; });
  write_bricks(writer, map.voxels());
  writer.finish();
  return bytes;
}

TEST(BrickArchive, AMapIsReadAsItWas) {
  const OccupancyMap map = map_with_wall();
  const std::string bytes = bytes_of(map);
  OccupancyMap read(walled);
  ByteReader reader(bytes);
  read_bricks(reader, read);
  EXPECT_TRUE(reader.at_end());
  const auto all = [](const Voxel& v) {
    return std::tuple(v.log_odds, v.probability, v.voxel_class, v.measured, v.occlusion_distance);
  };
  EXPECT_TRUE(std::ranges::equal(map.voxels(), read.voxels(), {}, all, all));
  EXPECT_EQ(bytes_of(read), bytes);
}

TEST(BrickArchive, TakesNoMoreForMoreFreeSpace) {
  constexpr std::size_t brick = 5 * VoxelBricks::brick_voxels, of_wall = 64;
  EXPECT_LT(bytes_of(map_with_wall()).size(), (of_wall + 2) * brick + 8 * 512 + 100)
      << "the wall's bricks, a free one, one with a mark, and where they stand";
  OccupancyMap read(walled);
  const std::string bytes = bytes_of(map_with_wall());
  ByteReader reader(bytes);
  read_bricks(reader, read);
  EXPECT_LT(read.voxels().bytes(), (of_wall + 2) * (brick + 100)) << "nor does the map that is read";
}

TEST(BrickArchive, WhatIsCutShortOrChangedIsRefused) {
  const std::string bytes = bytes_of(map_with_wall());
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 2) {
    OccupancyMap map(walled);
    ByteReader reader(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(read_bricks(reader, map), std::runtime_error) << size;
  }
  std::string other = bytes;
  other[8 + 3] = '\x7f';  // the first brick's place
  OccupancyMap map(walled);
  ByteReader reader(other);
  EXPECT_THROW(read_bricks(reader, map), std::runtime_error);
}

}  // namespace
}  // namespace nextview
