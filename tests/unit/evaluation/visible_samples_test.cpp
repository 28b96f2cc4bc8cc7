#include "core/evaluation/visible_samples.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "core/evaluation/candidate_sight.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/sensor/plane_scene.hpp"

namespace nextview {
namespace {

/// A camera in the origin that looks along z, and a surface across that in the way of rays.
class VisibleSamples : public testing::Test {
 protected:
  VisibleSamples() {
    config.width = 80, config.height = 60;
    config.field_of_view = 60.0;
    config.min_range = 0.2, config.max_range = 1.5;
    config.grazing_limit = 60.0;
  }
  /// Whether one sample is seen; its normal along the way that the camera looks unless it is given.
  bool sees(const Vector3& point, const Vector3& normal = Vector3::UnitZ(), double d_reg = any_slant,
            double surface_at = 5.0) const {
    const std::vector<Eigen::Vector3f> points = {point.cast<float>()}, normals = {normal.normalized().cast<float>()};
    const MeshRayCaster scene(plane({0, 0, surface_at}, Vector3::UnitZ()));
    const std::vector<std::uint32_t> asked = {0};
    return visible_samples({points, normals}, scene, DepthCamera(config), pose, asked, d_reg) == asked;
  }
  DepthCameraConfig config;
  Pose pose = Pose::Identity();
};

TEST_F(VisibleSamples, LieInTheImage) {
  const double half_width = std::tan(30.0 * degree), half_height = half_width * 60.0 / 80.0;
  for (const double side : {-1.0, 1.0}) {
    for (const auto& [share, is_seen] : {std::pair(0.999, true), std::pair(1.001, false)}) {
      EXPECT_EQ(sees({side * share * half_width, 0, 1}), is_seen) << side << ", " << share;
      EXPECT_EQ(sees({0, side * share * half_height, 1}), is_seen) << side << ", " << share;
    }
  }
  EXPECT_FALSE(sees({0, 0, -1})) << "behind the camera";
}

TEST_F(VisibleSamples, LieInTheRanges) {
  for (const auto& [range, is_seen] :
       {std::pair(0.199, false), std::pair(0.201, true), std::pair(1.499, true), std::pair(1.501, false)})
    EXPECT_EQ(sees({0, 0, range}), is_seen) << range;
  EXPECT_FALSE(sees({0.5, 0.3, 1.4})) << "the range is that along the ray";
}

TEST_F(VisibleSamples, AreHiddenByWhatIsBeforeThem) {
  for (const auto& [range, is_seen] : {std::pair(0.79, true), std::pair(0.8, true), std::pair(0.81, false)})
    EXPECT_EQ(sees({0.1, -0.1, range}, Vector3::UnitZ(), any_slant, 0.8), is_seen) << range;
}

TEST_F(VisibleSamples, AreNotSeenTooSlanted) {
  for (const double side : {-1.0, 1.0})
    for (const auto& [angle, is_seen] : {std::pair(59.9, true), std::pair(60.1, false)})
      EXPECT_EQ(sees({0, 0, 1}, {std::sin(angle * degree), 0, side * std::cos(angle * degree)}), is_seen)
          << side << ", " << angle;
}

// Pixels 1 / f of the range apart each way: half of their diagonal is within d_reg.
TEST_F(VisibleSamples, AreSeenBySomePixelWithinTheDistance) {
  const double focal_length = 40.0 / std::tan(30.0 * degree), half_diagonal = 0.5 * std::sqrt(2.0) / focal_length;
  EXPECT_TRUE(sees({0, 0, 1}, Vector3::UnitZ(), 1.001 * half_diagonal));
  EXPECT_FALSE(sees({0, 0, 1}, Vector3::UnitZ(), 0.999 * half_diagonal));
}

TEST_F(VisibleSamples, DependOnWhereTheCameraIs) {
  const Vector3 point(0.3, -0.2, 0.4);
  for (const Vector3& from : {Vector3(1, 0, 0), Vector3(0, 1, 0.4), Vector3(-0.3, -0.9, 0.1)}) {
    pose = look_at(from, point);
    EXPECT_TRUE(sees(point, point - from));
    pose = look_at(from, 2.0 * from - point);
    EXPECT_FALSE(sees(point, point - from)) << "the camera looks away";
  }
}

TEST_F(VisibleSamples, ComeInTheOrderInWhichTheyAreAskedFor) {
  constexpr std::uint32_t count = 10'000;  // more than are looked at at once
  std::vector<Eigen::Vector3f> points(count, {0, 0, 1}), normals(count, {0, 0, 1});
  std::vector<std::uint32_t> asked(count), expected;
  std::iota(asked.rbegin(), asked.rend(), 0u);
  for (std::uint32_t s = 0; s < count; s += 3) points[s].z() = 2.0f;  // too far
  std::ranges::copy_if(asked, std::back_inserter(expected), [](std::uint32_t s) { return s % 3 != 0; });
  const MeshRayCaster scene(plane({0, 0, 5}, Vector3::UnitZ()));
  EXPECT_EQ(visible_samples({points, normals}, scene, DepthCamera(config), pose, asked, any_slant), expected);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(visible_samples({points, normals}, scene, DepthCamera(config), pose, asked, any_slant, stop.get_token()),
               Stopped);
}

TEST(ResolvedRange, IsWherePixelsLieAsFarApartAsIsAskedFor) {
  const PinholeCamera square{640, 480, 100, 100, 320, 240}, flat{640, 480, 100, 80, 320, 240},
      high{640, 480, 80, 100, 320, 240};
  EXPECT_NEAR(resolved_range(square, 1.0, 0.005), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(resolved_range(square, 1.0, 0.01), 2.0 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(resolved_range(square, 0.5, 0.005), std::sqrt(0.2), 1e-12) << "one of two distances twice as long";
  EXPECT_NEAR(resolved_range(flat, 1.0, 0.005), 0.8 * std::sqrt(0.5), 1e-12) << "the pixels farther apart count";
  EXPECT_NEAR(resolved_range(high, 1.0, 0.005), 0.8 * std::sqrt(0.5), 1e-12);
}

/// Of seven samples the first view sees four, the second two more, and no other one any more.
CandidateSight sight() { return {std::vector<Pose>(5), {{0, 1, 2, 3}, {4, 5}, {3, 4}, {}, {0}}, 7}; }

TEST(CandidateSight, KnowsWhatAnyOfThemSees) {
  EXPECT_EQ(sight().seen_by_any(), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0}));
  EXPECT_EQ(sight().visible_samples(), 6u);
  EXPECT_EQ(CandidateSight().visible_samples(), 0u);
  EXPECT_TRUE(std::ranges::equal(sight().seen_from(2), std::vector<std::uint32_t>{3, 4}));
}

TEST(CandidateSight, AnOrderBeginsWithThoseThatCoverAllAndEndsWithTheOthers) {
  std::map<std::vector<std::size_t>, int> orders;
  constexpr int seeds = 200;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) ++orders[sight().covering_order(seed)];
  ASSERT_EQ(orders.size(), 2u);
  const int first = orders[{0, 1, 2, 3, 4}], second = orders[{1, 0, 2, 3, 4}];
  EXPECT_EQ(first + second, seeds);
  EXPECT_NEAR(first, seeds / 2, 35) << "shuffled evenly: 5 sigma";
}

TEST(CandidateSight, TheCoverIsShuffledEvenly) {
  const CandidateSight three{std::vector<Pose>(3), {{0}, {1}, {2}}, 3};
  std::map<std::vector<std::size_t>, int> orders;
  constexpr int seeds = 600;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) ++orders[three.covering_order(seed)];
  EXPECT_EQ(orders.size(), 6u);
  for (const auto& [order, count] : orders) EXPECT_NEAR(count, seeds / 6, 46) << "5 sigma";
}

TEST(CandidateSight, GreedyTakesWhatAddsMost) {
  // The second adds more after the first than the third, which alone sees more than it.
  const CandidateSight greedy{std::vector<Pose>(4), {{0, 1, 2, 3, 4}, {5, 6}, {2, 3, 4, 5}, {6}}, 7};
  const std::vector<std::size_t> order = greedy.covering_order(1);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.begin() + 2), (std::set<std::size_t>{0, 1}));
  EXPECT_EQ(order[2], 2u);
  EXPECT_EQ(order[3], 3u);
  EXPECT_TRUE(CandidateSight().covering_order(1).empty());
}

}  // namespace
}  // namespace nextview
