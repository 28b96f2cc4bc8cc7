// What a region of interest may be, and how lengths are told.
#include <gtest/gtest.h>

#include "core/config/object_lengths.hpp"

namespace nextview {
namespace {

/// Why a configuration is refused; empty if it is not.
std::string complaint(const Configuration& configuration) {
  try {
    configuration.validate();
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

// 1024 voxels along each side, 1000 m from the origin, and as far as octrees number voxels of that size: 2^15.
TEST(Region, MustBeABoxThatAMapCanHold) {
  const auto refusal = [](const std::string& region, double resolution) {
    Configuration configuration;
    give(configuration, "map.region", region, "map.region");
    give(configuration, "map.resolution", std::to_string(resolution), "map.resolution");
    return complaint(configuration);
  };
  EXPECT_EQ(refusal("0 0 0 10.24 1 0.01", 0.01), "");
  EXPECT_EQ(refusal("10.24 1 0.01 0 0 0", 0.01), "") << "the corners in any order";
  for (const char* flat : {"0 0 0 1 1 0", "0 0 0 1 0 1", "0 0 0 0 1 1"})
    EXPECT_EQ(refusal(flat, 0.01), std::string("map.region, ") + flat + ", must be a box with a volume");
  for (const char* wrong : {"0 0 0 10.25 1 1", "0 0 0 1 10.25 1", "0 0 0 1 1 0.009"})
    EXPECT_EQ(refusal(wrong, 0.01),
              std::string("map.region, ") + wrong + ", must be from 1 to 1024 voxels of 0.01 m along each side");
  EXPECT_EQ(refusal("326 0 0 327 1 1", 0.01), "");
  EXPECT_EQ(refusal("327 0 0 328 1 1", 0.01), "map.region, 327 0 0 328 1 1, must lie within 327.68 m of the origin");
  EXPECT_EQ(refusal("0 0 -328 1 1 -327", 0.01),
            "map.region, 0 0 -328 1 1 -327, must lie within 327.68 m of the origin");
  EXPECT_EQ(refusal("0 999 0 1 1000 1", 0.1), "");
  EXPECT_EQ(refusal("0 999.5 0 1 1000.5 1", 0.1),
            "map.region, 0 999.5 0 1 1000.5 1, must lie within 1000 m of the origin");
  EXPECT_NE(refusal("0 0 0 1 1", 0.01), "") << "five numbers";
}

// Lengths that the object decides are not held against each other before it is known.
TEST(Region, ACubeHasOneToOneThousandAndTwentyFourVoxels) {
  const auto refusal = [](const char* edge, const char* resolution) {
    Configuration configuration;
    give(configuration, "map.region_edge", edge, "map.region_edge");
    if (resolution) give(configuration, "map.resolution", resolution, "map.resolution");
    return complaint(configuration);
  };
  EXPECT_EQ(refusal("512", "0.5"), "");
  EXPECT_EQ(refusal("0.5", "0.5"), "");
  EXPECT_EQ(refusal("512.5", "0.5"),
            "map.region_edge / map.resolution must be from 1 to 1024 voxels, not 1025: make voxels 510 mm or larger");
  EXPECT_EQ(refusal("0.25", "0.5"),
            "map.region_edge / map.resolution must be from 1 to 1024 voxels, not 0.5: make voxels 250 mm or smaller");
  EXPECT_EQ(refusal("1000", nullptr), "");
}

TEST(Region, IsTheCubeOfItsEdgeWhereNoBoxIsGiven) {
  MapConfig map;
  map.region_edge = 3.0;
  EXPECT_EQ(map.region_box().min(), Vector3(-1.5, -1.5, -1.5));
  EXPECT_EQ(map.region_box().max(), Vector3(1.5, 1.5, 1.5));
  map.region = "1 -2 3 -4 5 -6";
  EXPECT_EQ(map.region_box().min(), Vector3(-4, -2, -6));
  EXPECT_EQ(map.region_box().max(), Vector3(1, 5, 3));
}

// In metres from 1 m on, along whichever side.
TEST(Lengths, SizesAreToldInTheUnitThatSuits) {
  const auto told = [](const Vector3& size) {
    return size_text(Eigen::AlignedBox3d(Vector3(1, 2, 3), Vector3(Vector3(1, 2, 3) + size)));
  };
  EXPECT_EQ(told({0.25, 0.5, 0.125}), "250 x 500 x 125 mm");
  EXPECT_EQ(told({0.25, 0.5, 1.0}), "0.25 x 0.5 x 1 m");
  EXPECT_EQ(told({1.5, 0.25, 0.5}), "1.5 x 0.25 x 0.5 m");
  EXPECT_EQ(told({0.0625, 0.5, 0.999}), "62.5 x 500 x 999 mm");
}

TEST(Lengths, OfAScanAreToldInOneLine) {
  Configuration c;
  c.map.resolution = 0.01, c.map.region_edge = 1.28, c.views.radius = 0.9;
  c.sensor.min_range = 0.2, c.sensor.max_range = 1.5, c.sensor.range_noise = 0.002, c.evaluation.d_reg = 0.005;
  const std::string rest = ", views from 900 mm, a camera for 200 mm to 1.5 m with 2 mm of noise, d_reg 5 mm";
  EXPECT_EQ(lengths_text(c), "voxels 10 mm, region 1.28 m" + rest);
  c.map.region = "0 0 0 0.25 0.5 0.75";
  EXPECT_EQ(lengths_text(c), "voxels 10 mm, region 250 x 500 x 750 mm" + rest);
}

}  // namespace
}  // namespace nextview
