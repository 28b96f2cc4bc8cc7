#include "core/map/occupancy_map.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/map/octomap_twin.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

using octomap_twin::compare;

VoxelGrid region(double resolution) { return region_of_interest(Vector3(0.013, -0.02, 0.04), 0.44, resolution); }

bool same_bytes(const OccupancyMap& a, const OccupancyMap& b) {
  return std::equal(a.voxels().begin(), a.voxels().end(), b.voxels().begin(), b.voxels().end(),
                    [](const Voxel& x, const Voxel& y) {
                      return x.log_odds == y.log_odds && x.probability == y.probability && x.entropy == y.entropy &&
                             x.voxel_class == y.voxel_class && x.measured == y.measured &&
                             x.occlusion_distance == y.occlusion_distance;
                    });
}

std::vector<Scan> scans(double resolution, int rays, double max_range, int misses) {
  std::mt19937 random(17);
  std::vector<Scan> result;
  for (const Vector3& origin : random_scans::origins()) {
    result.push_back(random_scans::scan(random, origin, resolution, rays, max_range));
    random_scans::add_passes(result.back(), random, misses);
  }
  return result;
}

TEST(OccupancyMap, EqualsOctoMapsInsertPointCloudToTheBit) {
  for (const double resolution : {0.01, 0.02})
    for (const double max_range : {1.5, 0.8}) {
      OccupancyMap map(region(resolution), {});
      octomap::OcTree tree = octomap_twin::tree(resolution, {});
      std::size_t measured = 0;
      for (const Scan& scan : scans(resolution, 600, max_range, 0)) {
        map.insert(scan);
        octomap_twin::insert(tree, scan);
        const auto [now_measured, different] = compare(map, tree);
        EXPECT_EQ(different, 0u) << resolution << " m, range " << max_range << " m";
        measured = now_measured;
      }
      EXPECT_GT(measured, 3000u);
    }
}

TEST(OccupancyMap, EqualsOctoMapUnderOtherSensorModels) {
  InverseSensorModel bold, timid;
  bold.hit = 0.99, bold.miss = 0.02;  // each beyond the clamps at once
  timid.hit = 0.51, timid.miss = 0.499, timid.clamp_min = 0.3, timid.clamp_max = 0.6;
  for (const InverseSensorModel& model : {bold, timid}) {
    OccupancyMap map(region(0.02), model);
    octomap::OcTree tree = octomap_twin::tree(0.02, model);
    for (int round = 0; round < 3; ++round)
      for (const Scan& scan : scans(0.02, 400, 1.5, 0)) {
        map.insert(scan);
        octomap_twin::insert(tree, scan);
      }
    EXPECT_EQ(compare(map, tree).different, 0u);
  }
}

TEST(OccupancyMap, PassesCarveAsOctoMapsRaysToTheSamePoints) {
  for (const double resolution : {0.01, 0.02}) {
    OccupancyMap map(region(resolution), {});
    octomap::OcTree tree = octomap_twin::tree(resolution, {});
    for (const Scan& scan : scans(resolution, 200, 1.5, 300)) {
      map.insert(scan);
      octomap_twin::insert(tree, scan);
      EXPECT_EQ(compare(map, tree).different, 0u) << resolution;
    }
  }
}

// A return twice as far along the same ray is cut at the maximum range: up to the rounding of the cut it is a pass.
TEST(OccupancyMap, PassesCarveAsReturnsBeyondTheMaximumRange) {
  OccupancyMap with_passes(region(0.02), {}), with_returns(region(0.02), {});
  for (const Scan& scan : scans(0.02, 0, 1.5, 2000)) {
    Scan far{scan.origin, {}, {}, 1.5};
    for (const auto& p : scan.misses) far.hits.push_back(2.0f * p - scan.origin.cast<float>());
    with_passes.insert(scan);
    with_returns.insert(far);
  }
  std::size_t measured = 0, different = 0;
  for (std::size_t i = 0; i < with_passes.grid().voxel_count(); ++i) {
    measured += with_passes.voxels()[i].measured;
    different += with_passes.log_odds(i) != with_returns.log_odds(i);
    EXPECT_LE(with_passes.log_odds(i), 0.0f);
  }
  EXPECT_GT(measured, 5000u);
  EXPECT_LE(different, measured / 1000);
}

TEST(OccupancyMap, AnEndIsAHitHoweverManyRaysPassIt) {
  OccupancyMap map(region(0.01), {});
  const Eigen::Vector3f end(0.105f, 0.005f, 0.005f), beyond(0.205f, 0.005f, 0.005f);
  map.insert({Vector3(-0.195, 0.005, 0.005), {beyond, end, beyond, end}, {}, 1.5});
  const auto log_odds_at = [&](const Eigen::Vector3f& p) {
    return map.log_odds(map.grid().index(map.grid().cell_at(p.cast<double>())));
  };
  EXPECT_FLOAT_EQ(log_odds_at(end), float(std::log(0.7 / 0.3)));
  EXPECT_FLOAT_EQ(log_odds_at(beyond), float(std::log(0.7 / 0.3)));
  EXPECT_FLOAT_EQ(log_odds_at({0.155f, 0.005f, 0.005f}), float(std::log(0.4 / 0.6)));
}

TEST(OccupancyMap, InvalidPixelsCarveNothing) {
  DepthImage image;
  image.camera = PinholeCamera::from_field_of_view(40, 30, 1.0);
  image.range.assign(1200, DepthImage::invalid);
  const Pose pose = look_at(Vector3(0.8, 0.1, 0.2), Vector3::Zero());
  OccupancyMap map(region(0.01), {});
  map.insert(back_project(image, pose, 1.5));
  for (const Voxel& v : map.voxels()) ASSERT_FALSE(v.measured);

  // One valid pixel among them: the same as that ray alone.
  image.range[615] = 0.8f;
  const Scan scan = back_project(image, pose, 1.5);
  ASSERT_EQ(scan.hits.size() + scan.misses.size(), 1u);
  map.insert(scan);
  OccupancyMap alone(region(0.01), {});
  alone.insert({pose.translation(), {scan.hits[0]}, {}, 1.5});
  EXPECT_TRUE(same_bytes(map, alone));
  EXPECT_GT(std::count_if(map.voxels().begin(), map.voxels().end(), [](const Voxel& v) { return v.measured; }), 10);
}

TEST(OccupancyMap, RegisteringLocalMapsGivesTheSameMap) {
  InverseSensorModel bold;
  bold.hit = 0.99, bold.miss = 0.02;  // one scan is at the clamps already
  for (const InverseSensorModel& model : {InverseSensorModel(), bold}) {
    OccupancyMap direct(region(0.01), model), registered(region(0.01), model);
    for (int round = 0; round < 3; ++round)  // into the clamps
      for (const Scan& scan : scans(0.01, 1000, 1.5, 500)) {
        direct.insert(scan);
        OccupancyMap local(region(0.01), model);
        local.insert(scan);
        registered.register_local(local, scan.origin);
        ASSERT_TRUE(same_bytes(direct, registered));
      }
  }
}

TEST(OccupancyMap, RegistersNoMapOfAnotherKind) {
  OccupancyMap map(region(0.02), {});
  InverseSensorModel other;
  other.hit = 0.8;
  EXPECT_THROW(map.register_local(OccupancyMap(region(0.01), {}), Vector3::Zero()), std::invalid_argument);
  EXPECT_THROW(map.register_local(OccupancyMap(region(0.02), other), Vector3::Zero()), std::invalid_argument);
  EXPECT_THROW(map.register_local(OccupancyMap(region_of_interest(Vector3(1, 0, 0), 0.64, 0.02), {}), Vector3::Zero()),
               std::invalid_argument);
}

TEST(OccupancyMap, TheSameBytesOnOneThreadAndTwo) {
  const auto build = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    OccupancyMap map(region(0.01), {});
    for (const Scan& scan : scans(0.01, 3000, 1.5, 1000)) {
      map.insert(scan);
      map.mark_occlusions(scan, 0.3);
    }
    return map;
  };
  EXPECT_TRUE(same_bytes(build(1), build(2)));
}

TEST(OccupancyMap, VoxelsAgreeWithTheirLogOdds) {
  OccupancyMap map(region(0.02), {});
  for (int round = 0; round < 3; ++round)
    for (const Scan& scan : scans(0.02, 2000, 1.5, 500)) map.insert(scan);
  std::array<std::size_t, 3> seen{};
  for (std::size_t i = 0; i < map.voxels().size(); ++i) {
    const Voxel& v = map.voxels()[i];
    const double p = v.measured ? 1.0 - 1.0 / (1.0 + std::exp(double(map.log_odds(i)))) : 0.5;
    ASSERT_NEAR(v.probability, p, 1e-6);
    ASSERT_NEAR(v.entropy, -p * std::log(p) - (1 - p) * std::log(1 - p), 1e-6);
    ASSERT_GE(p, 0.12 - 1e-6);
    ASSERT_LE(p, 0.97 + 1e-6);
    ASSERT_EQ(v.voxel_class, p > 0.8 ? VoxelClass::occupied : p < 0.2 ? VoxelClass::free : VoxelClass::unknown);
    ++seen[std::size_t(v.voxel_class)];
  }
  for (const std::size_t n : seen) EXPECT_GT(n, 10u);
}

// A second hit makes a voxel occupied, a first does not.
TEST(OccupancyMap, AFirstHitIsNotYetOccupied) {
  OccupancyMap map(region(0.01), {});
  const Scan scan{Vector3(0.8, 0.003, 0.004), {{0.1f, 0.004f, 0.003f}}, {}, 1.5};
  const std::uint32_t voxel = map.grid().index(map.grid().cell_at(scan.hits[0].cast<double>()));
  map.insert(scan);
  EXPECT_EQ(map.voxels()[voxel].voxel_class, VoxelClass::unknown);
  EXPECT_NEAR(map.voxels()[voxel].probability, 0.7, 1e-6);
  map.insert(scan);
  EXPECT_EQ(map.voxels()[voxel].voxel_class, VoxelClass::occupied);
}

/// Most of what a later view passes is as free as it can be.
TEST(OccupancyMap, WhatIsAtItsClampsStaysShared) {
  const Scan scan = scans(0.01, 600, 1.5, 100).front();
  OccupancyMap map(region(0.01), {});
  for (int k = 0; k < 3; ++k) map.insert(scan);
  OccupancyMap before = map;
  map.insert(scan);
  EXPECT_GT(map.voxels().bytes_beside(before.voxels()), 0u);
  for (int k = 0; k < 8; ++k) map.insert(scan);
  before = map;
  map.insert(scan);
  EXPECT_LE(map.voxels().bytes_beside(before.voxels()), map.voxels().brick_count() * sizeof(void*))
      << "the table alone";
  EXPECT_TRUE(same_bytes(map, before));
}

TEST(OccupancyMap, RejectsModelsThatMakeNoSense) {
  const auto rejects = [](auto change) {
    InverseSensorModel model;
    change(model);
    EXPECT_THROW(model.validate(), std::invalid_argument);
    EXPECT_THROW(OccupancyMap(region(0.02), model), std::invalid_argument);
  };
  for (const double bad : {-0.1, 0.0, 1.0, 1.5, std::nan("")}) {
    rejects([&](auto& m) { m.hit = bad; });
    rejects([&](auto& m) { m.miss = bad; });
    rejects([&](auto& m) { m.clamp_min = bad; });
    rejects([&](auto& m) { m.clamp_max = bad; });
    rejects([&](auto& m) { m.occupancy_threshold = bad; });
  }
  rejects([](auto& m) { m.hit = 0.4; });
  rejects([](auto& m) { m.miss = 0.6; });
  rejects([](auto& m) { m.clamp_min = 0.98; });
  rejects([](auto& m) { m.free_below = 0.9; });
  rejects([](auto& m) { m.free_below = std::nan(""); });
  rejects([](auto& m) { m.occupied_above = std::nan(""); });
}

}  // namespace
}  // namespace nextview
