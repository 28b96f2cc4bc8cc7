#include "core/gain/expected_view.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "core/gain/map_rays.hpp"
#include "tests/unit/gain/scripted_rays.hpp"
#include "tests/unit/map/random_scans.hpp"
#include "tests/unit/map/slab_test.hpp"

namespace nextview {
namespace {

const VoxelGrid around_origin{0.05, {-8, -8, -8}, {16, 16, 16}};  // 0.8 m around the origin
constexpr double undecided = 0.5;
const PinholeCamera camera = PinholeCamera::from_field_of_view(90, 60, 1.0);

Voxel known(double p) { return voxel(p, true); }

/// The box of voxels whose centres lie within `half` of the origin.
bool in_box(std::uint32_t v, const Vector3& half) {
  return (around_origin.centre(v).array().abs() < half.array()).all();
}

/// Ray number i of a view, in the world.
Vector3 direction(const Pose& pose, int columns, int rows, std::size_t i) {
  const double u = (double(int(i) % columns) + 0.5) * camera.width / columns - 0.5;
  const double v = (double(int(i) / columns) + 0.5) * camera.height / rows - 0.5;
  return pose.linear() * camera.direction(u, v);
}

TEST(ExpectedView, SeesABoxWhereItsFacesAre) {
  const Vector3 half(0.2, 0.15, 0.1);
  std::vector<Voxel> voxels(around_origin.voxel_count(), known(0.12));
  for (std::uint32_t v = 0; v < voxels.size(); ++v)
    if (in_box(v, half)) voxels[v] = known(0.97);
  const MapRays rays(around_origin, {around_origin.size, voxels}, undecided, 3.0);
  std::mt19937 random(3);
  std::size_t met = 0, missed = 0;
  for (int view = 0; view < 30; ++view) {
    const Pose pose = look_at(0.9 * random_scans::direction(random), random_scans::point_in_box(random, 0.1));
    const ExpectedView seen = expected_view(rays, pose, camera, 45, 30);
    ASSERT_EQ(seen.columns, 45);
    ASSERT_EQ(seen.rows, 30);
    ASSERT_EQ(seen.depth.size(), 45u * 30u);
    for (std::size_t i = 0; i < seen.depth.size(); ++i) {
      const Vector3 along = direction(pose, 45, 30, i);
      const auto box = slab_test::overlap(-half, half, pose.translation(), along, 0.0, 3.0);
      EXPECT_EQ(seen.unknown[i], 0) << "everything is known";
      if (std::abs(box.length()) < 1e-6) continue;  // grazes an edge
      if (box.length() > 0.0) {
        ASSERT_NEAR(seen.depth[i], along.dot(pose.linear().col(2)) * box.enter, 1e-5);
        ++met;
      } else {
        ASSERT_LT(seen.depth[i], 0.0f);
        ++missed;
      }
    }
  }
  EXPECT_GT(met, 1000u);
  EXPECT_GT(missed, 1000u);
}

TEST(ExpectedView, ADepthIsAlongTheOpticalAxis) {
  std::vector<Voxel> voxels(around_origin.voxel_count(), known(0.12));
  for (std::uint32_t v = 0; v < voxels.size(); ++v)
    if (around_origin.cell(v).x() == 0) voxels[v] = known(0.97);  // the wall at x = -0.4 .. -0.35
  const Pose pose = look_at(Vector3(0.3, 0.0, 0.0), Vector3::Zero());
  const ExpectedView seen =
      expected_view(MapRays(around_origin, {around_origin.size, voxels}, undecided, 3.0), pose, camera, 9, 6);
  for (const float depth : seen.depth) EXPECT_NEAR(depth, 0.65, 1e-6) << "a wall across the view has one depth";
}

// Each ray against the slab test of every voxel.
TEST(ExpectedView, AgreesWithTheSlabTestOfAllVoxels) {
  std::mt19937 random(5);
  std::vector<Voxel> voxels(around_origin.voxel_count());
  for (Voxel& v : voxels) {
    const auto kind = random() % 40;
    v = kind == 0 ? known(0.9) : kind == 1 ? known(undecided) : kind < 4 ? Voxel(unmeasured()) : known(0.3);
  }
  const MapRays rays(around_origin, {around_origin.size, voxels}, undecided, 0.9);
  std::size_t stopped = 0, crossed_unknown = 0, both = 0;
  for (int view = 0; view < 12; ++view) {
    const Pose pose = look_at(view % 3 == 0 ? random_scans::point_in_box(random, 0.3)  // inside the region
                                            : Vector3(0.8 * random_scans::direction(random)),
                              random_scans::point_in_box(random, 0.3));
    const ExpectedView seen = expected_view(rays, pose, camera, 12, 8);
    for (std::size_t i = 0; i < seen.depth.size(); ++i) {
      const Vector3 origin = pose.translation(), along = direction(pose, 12, 8, i);
      double stop = 0.9;
      bool stops = false;
      for (std::uint32_t v = 0; v < voxels.size(); ++v) {
        const auto at = slab_test::overlap(around_origin, v, 0.0, origin, along, 0.9);
        if (at.length() < 1e-9 || !voxels[v].measured || voxels[v].probability < float(undecided)) continue;
        if (at.enter < stop) stop = at.enter, stops = true;
      }
      bool unknown = false;
      for (std::uint32_t v = 0; v < voxels.size(); ++v)
        unknown |=
            !voxels[v].measured && slab_test::overlap(around_origin, v, 0.0, origin, along, stop).length() > 1e-9;
      if (stops)
        ASSERT_NEAR(seen.depth[i], stop * along.dot(pose.linear().col(2)), 1e-6);
      else
        ASSERT_LT(seen.depth[i], 0.0f);
      ASSERT_EQ(seen.unknown[i] != 0, unknown) << view << " " << i;
      stopped += stops, crossed_unknown += unknown, both += stops && unknown;
    }
  }
  EXPECT_GT(stopped, 100u);
  EXPECT_GT(crossed_unknown, 100u);
  EXPECT_GT(both, 50u);
}

TEST(ExpectedView, AnEmptyMapShowsNothingAndAllOfItUnknown) {
  const std::vector<Voxel> voxels(around_origin.voxel_count());
  const MapRays rays(around_origin, {around_origin.size, voxels}, undecided, 3.0);
  const ExpectedView towards = expected_view(rays, look_at(Vector3(0.9, 0, 0), Vector3::Zero()), camera, 3, 3);
  const ExpectedView away = expected_view(rays, look_at(Vector3(0.9, 0, 0), Vector3(2, 0, 0)), camera, 3, 3);
  EXPECT_TRUE(std::ranges::all_of(towards.depth, [](float d) { return d < 0.0f; }));
  EXPECT_TRUE(std::ranges::all_of(away.depth, [](float d) { return d < 0.0f; }));
  EXPECT_TRUE(std::ranges::all_of(towards.unknown, [](auto u) { return u == 1; }));
  EXPECT_TRUE(std::ranges::all_of(away.unknown, [](auto u) { return u == 0; })) << "these rays miss the region";
  EXPECT_THROW(expected_view(rays, Pose::Identity(), camera, 0, 3), std::invalid_argument);
}

TEST(ExpectedView, TheSameOnOneThreadAndTwo) {
  std::mt19937 random(7);
  std::vector<Voxel> voxels(around_origin.voxel_count());
  for (Voxel& v : voxels) v = random() % 30 == 0 ? known(0.9) : random() % 30 == 0 ? Voxel(unmeasured()) : known(0.2);
  const MapRays rays(around_origin, {around_origin.size, voxels}, undecided, 3.0);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return expected_view(rays, look_at(Vector3(0.7, 0.5, 0.3), Vector3::Zero()), camera, 80, 60);
  };
  const ExpectedView one = run(1), two = run(2);
  EXPECT_EQ(one.depth, two.depth);
  EXPECT_EQ(one.unknown, two.unknown);
}

}  // namespace
}  // namespace nextview
