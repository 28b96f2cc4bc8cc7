#include "core/config/object_lengths.hpp"

#include <gtest/gtest.h>

#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/setting/length_text.hpp"
#include "core/setting/percent_text.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

std::string text(Configuration c, const std::string& key) {
  auto all = settings(c);
  return find_setting(all, key).text();
}

TEST(ObjectLengths, HalfAMetreIsTheDefault) {
  Configuration c;
  fit_lengths(c, 0.5);
  EXPECT_EQ(to_toml(c), to_toml(Configuration()));
}

TEST(ObjectLengths, FollowTheObject) {
  Configuration c;
  fit_lengths(c, double(0.0915f));
  EXPECT_EQ(c.map.resolution, 0.002);
  EXPECT_DOUBLE_EQ(c.map.region_edge, 0.23424);
  EXPECT_DOUBLE_EQ(c.views.radius, 0.1647);
  EXPECT_DOUBLE_EQ(c.map.occlusion_distance, 0.06);
  EXPECT_DOUBLE_EQ(c.planner.ray_length, 0.2745);
  EXPECT_DOUBLE_EQ(c.evaluation.d_reg, 0.000915);
  EXPECT_DOUBLE_EQ(c.sensor.min_range, 0.0366);
  EXPECT_DOUBLE_EQ(c.sensor.max_range, 0.2745);
  EXPECT_DOUBLE_EQ(c.sensor.range_noise, 0.000366);
  EXPECT_NO_THROW(c.validate());
}

TEST(ObjectLengths, VoxelsAreOneTwoOrFiveTimesAPowerOfTen) {
  for (const auto& [longest, resolution] : {std::pair{0.012, 0.0002},
                                            {0.03, 0.0005},
                                            {0.0345, 0.0005},
                                            {0.036, 0.001},
                                            {0.069, 0.001},
                                            {0.072, 0.002},
                                            {0.5, 0.01},
                                            {0.65, 0.01},
                                            {0.75, 0.02},
                                            {2.0, 0.05},
                                            {30.0, 0.5}}) {
    Configuration c;
    fit_lengths(c, longest);
    EXPECT_NEAR(c.map.resolution, resolution, 1e-12) << longest;
    EXPECT_NO_THROW(c.validate()) << longest;
  }
}

TEST(ObjectLengths, OfVerySmallAndVeryLargeObjectsAreAllowed) {
  for (const double longest : {0.0005, 0.003, 80.0}) {
    Configuration c;
    fit_lengths(c, longest);
    EXPECT_NO_THROW(c.validate()) << longest;
  }
  Configuration c;
  fit_lengths(c, 0.003);
  EXPECT_DOUBLE_EQ(c.map.resolution, 0.00005);
  EXPECT_LT(c.views.radius, c.sensor.max_range) << "nothing would be seen";
}

TEST(ObjectLengths, WhatIsGivenStays) {
  Configuration c;
  give(c, "map.resolution", "0.01", "--resolution");  // as it is by default
  c.views.radius = 0.3;                               // by a program
  fit_lengths(c, 0.2);
  EXPECT_EQ(c.map.resolution, 0.01);
  EXPECT_EQ(c.views.radius, 0.3);
  EXPECT_DOUBLE_EQ(c.map.region_edge, 0.512);
  EXPECT_DOUBLE_EQ(c.sensor.max_range, 0.6);
}

TEST(ObjectLengths, ANamedSensorStaysAsItIs) {
  Configuration c;
  give(c, "sensor.preset", "paper", "--sensor");
  const std::string before = text(c, "sensor.max_range");
  fit_lengths(c, 0.1);
  EXPECT_EQ(text(c, "sensor.max_range"), before);
  EXPECT_DOUBLE_EQ(c.views.radius, 0.18);
}

TEST(ObjectLengths, FollowTheNextObjectToo) {
  Configuration c;
  fit_lengths(c, 0.2);
  give(c, "views.radius", "0.25", "radius");
  fit_lengths(c, 0.4);
  EXPECT_DOUBLE_EQ(c.map.region_edge, 1.024);
  EXPECT_EQ(c.views.radius, 0.25);
  give(c, "views.radius", "0.36", "radius");  // back to what was fitted
  EXPECT_DOUBLE_EQ(c.sensor.range_noise, 0.0016);
}

TEST(ObjectLengths, ReadFromItsOwnFileNothingFollows) {
  Configuration c;
  fit_lengths(c, 0.2);
  const TemporaryFolder own;
  const auto file = own / "lengths.toml";
  write_file(file, to_toml(c));
  Configuration read = read_configuration(file);
  fit_lengths(read, 3.0);
  EXPECT_EQ(to_toml(read), to_toml(c));
}

TEST(ObjectLengths, RaysReachFromTheWorkingDistance) {
  Configuration c;
  c.sensor.working_distance = 2.0;
  fit_lengths(c, 0.5);
  EXPECT_DOUBLE_EQ(c.views.radius, 2.0);
  EXPECT_DOUBLE_EQ(c.planner.ray_length, 2.6);
  c.sensor.working_distance = 0.5;
  fit_lengths(c, 0.5);
  EXPECT_DOUBLE_EQ(c.planner.ray_length, 1.5);
}

TEST(ObjectLengths, RaysGetThroughTheRegionFromWhereverViewsAre) {
  Configuration c;
  c.map.region = "-0.1 -0.1 -0.1 0.1 0.1 0.1";
  fit_lengths(c, 0.2);
  const std::vector<Pose> near = {Pose(Eigen::Translation3d(0.2, 0, 0))},
                          far = {near[0], Pose(Eigen::Translation3d(0, 1, 0))};
  lengthen_rays(c, near);
  EXPECT_DOUBLE_EQ(c.planner.ray_length, 0.6);
  lengthen_rays(c, far);
  EXPECT_NEAR(c.planner.ray_length, 1.01 * (1.0 + 0.1 * std::sqrt(3.0)), 1e-5);
  give(c, "planner.ray_length", "0.3", "--planner.ray_length");
  lengthen_rays(c, far);
  EXPECT_DOUBLE_EQ(c.planner.ray_length, 0.3);
}

TEST(ObjectLengths, TheRegionLiesAroundAnObjectThatStaysWhereItIs) {
  const Eigen::AlignedBox3d object(Vector3(5.0, 0.0, 0.0), Vector3(5.12, 0.08, 0.09));
  Configuration c;
  fit_region(c, object);
  EXPECT_EQ(c.map.region, "") << "it is put in the origin";
  c.object.centred = false;
  c.map.region_edge = 0.4;
  fit_region(c, object);
  EXPECT_EQ(c.map.region, "4.86 -0.16 -0.155 5.26 0.24 0.245");
  fit_region(c, {object.min() + Vector3::UnitY(), object.max() + Vector3::UnitY()});
  EXPECT_EQ(c.map.region, "4.86 0.84 -0.155 5.26 1.24 0.245") << "of the next object";
  c.object.centred = true;
  fit_region(c, object);
  EXPECT_EQ(c.map.region, "");
  c.object.centred = false;
  give(c, "map.region", "0 0 0 1 1 1", "--map.region");
  fit_region(c, object);
  EXPECT_EQ(c.map.region, "0 0 0 1 1 1") << "what was given stays";
}

TEST(ObjectLengths, AsText) {
  EXPECT_EQ(length_text(0.0915), "91.5 mm");
  EXPECT_EQ(length_text(1.5), "1.5 m");
  EXPECT_EQ(length_text(999.4), "999 m");
  EXPECT_EQ(length_text(999.6), "1000 m");
  EXPECT_EQ(length_text(1553.2), "1553 m");
  EXPECT_EQ(length_text(0.99949), "999 mm");
  EXPECT_EQ(length_text(0.99951), "1 m") << "not 1e+03 mm";
  EXPECT_EQ(percent_text(0.0045), "0.45 %");
  EXPECT_EQ(percent_text(0.994), "99 %");
  EXPECT_EQ(percent_text(0.996), "100 %") << "not 1e+02 %";
}

/// A box of these sides, in the numbers of an STL file.
std::filesystem::path box_file(const TemporaryFolder& folder, const std::string& name, const Eigen::Vector3d& sides) {
  std::string text = "solid box\n";
  const auto corner = [&](int c) {
    return Eigen::Vector3d(c & 1 ? sides.x() : 0, c & 2 ? sides.y() : 0, c & 4 ? sides.z() : 0);
  };
  for (const auto& [a, b, c] : {std::array{0, 2, 1},
                                {1, 2, 3},
                                {4, 5, 6},
                                {5, 7, 6},
                                {0, 1, 4},
                                {1, 5, 4},
                                {2, 6, 3},
                                {3, 6, 7},
                                {0, 4, 2},
                                {2, 4, 6},
                                {1, 3, 5},
                                {3, 7, 5}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int k : {a, b, c}) {
      const Eigen::Vector3d at = corner(k);
      text += "vertex " + std::to_string(at.x()) + " " + std::to_string(at.y()) + " " + std::to_string(at.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  const auto file = folder / name;
  write_file(file, text + "endsolid box\n");
  return file;
}

double longest_of(const std::filesystem::path& file, const ObjectConfig& object = {}) {
  return load_mesh(file, placement(object, file)).bounding_box().sizes().maxCoeff();
}

TEST(ObjectLengths, TheUnitOfAFileIsGuessedFromItsSize) {
  const TemporaryFolder own;
  EXPECT_NEAR(longest_of(box_file(own, "millimetres.stl", {91.5, 20, 30})), 0.0915, 1e-7);
  EXPECT_NEAR(longest_of(box_file(own, "metres.stl", {2, 0.5, 1})), 2.0, 1e-6);
  EXPECT_NEAR(longest_of(box_file(own, "ten.stl", {10, 0.5, 1})), 10.0, 1e-5);
  const auto small = box_file(own, "small.stl", {8, 4, 4});
  ObjectConfig object;
  object.unit = LengthUnit::millimetres;
  EXPECT_NEAR(longest_of(small, object), 0.008, 1e-8);
  object.unit = LengthUnit::inches;
  EXPECT_NEAR(longest_of(small, object), 0.2032, 1e-7);
  object.longest_side = 0.5;
  EXPECT_NEAR(longest_of(small, object), 0.5, 1e-6);
}

}  // namespace
}  // namespace nextview
