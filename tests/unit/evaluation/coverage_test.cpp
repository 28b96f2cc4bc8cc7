#include "core/evaluation/coverage.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace nextview {
namespace {

/// Points on a sphere of 0.2 m, give or take.
PointCloud on_sphere(unsigned seed, int count, float spread) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal;
  PointCloud points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f direction(normal(generator), normal(generator), normal(generator));
    points.push_back((0.2f + spread * normal(generator)) * direction.normalized() + Eigen::Vector3f(0.3f, -1.0f, 2.0f));
  }
  return points;
}

std::vector<std::uint8_t> every_third(std::size_t count) {
  std::vector<std::uint8_t> mask(count, 0);
  for (std::size_t i = 0; i < count; i += 3) mask[i] = 1;
  return mask;
}

TEST(SurfaceCoverage, AgreesWithAllPairs) {
  const PointCloud samples = on_sphere(1, 3000, 0.0f), first = on_sphere(2, 700, 0.002f),
                   second = on_sphere(3, 500, 0.02f);
  const auto visible = every_third(samples.size());
  for (const double d_reg : {0.0005, 0.005, 0.02, 0.3, 1.0}) {
    SurfaceCoverage coverage(samples, d_reg);
    EXPECT_EQ(coverage.of_all(), 0.0);
    PointCloud cloud;
    for (const PointCloud& view : {first, second}) {
      coverage.add(view);
      cloud.insert(cloud.end(), view.begin(), view.end());
      std::size_t all = 0, seen = 0, seeable = 0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        double nearest = INFINITY;
        for (const auto& p : cloud) nearest = std::min(nearest, (p.cast<double>() - samples[i].cast<double>()).norm());
        ASSERT_EQ(bool(coverage.observed()[i]), nearest <= d_reg) << d_reg << " sample " << i << " at " << nearest;
        all += nearest <= d_reg;
        seen += nearest <= d_reg && i % 3 == 0;
        seeable += i % 3 == 0;
      }
      EXPECT_DOUBLE_EQ(coverage.of_all(), double(all) / double(samples.size()));
      EXPECT_DOUBLE_EQ(coverage.of(visible), double(seen) / double(seeable));
    }
    EXPECT_GT(coverage.of_all(), 0.0) << d_reg;
  }
}

TEST(SurfaceCoverage, AFlatSurfaceAndASinglePointWork) {
  PointCloud plane;
  for (int i = 0; i < 100; ++i) plane.emplace_back(0.01f * float(i % 10), 0.0f, 0.01f * float(i / 10));
  SurfaceCoverage flat(plane, 0.001);
  flat.add({{0.05f, 0.0005f, 0.05f}, {0.05f, 0.0015f, 0.06f}, {9e9f, -9e9f, 9e9f}});
  EXPECT_DOUBLE_EQ(flat.of_all(), 0.01);

  SurfaceCoverage single(PointCloud{{1, 2, 3}}, 0.5);
  single.add({});
  EXPECT_EQ(single.of_all(), 0.0);
  single.add({{1.0f, 2.0f, 3.5f}});  // exactly at d_reg: within
  EXPECT_EQ(single.of_all(), 1.0);
  EXPECT_EQ(single.of(std::vector<std::uint8_t>{0}), 0.0);  // none counts
}

TEST(SurfaceCoverage, DoesNotDependOnTheNumberOfThreads) {
  const PointCloud samples = on_sphere(4, 20000, 0.0f), points = on_sphere(5, 50000, 0.003f);
  SurfaceCoverage many(samples, 0.002), one(samples, 0.002);
  many.add(points);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  one.add(points);
  EXPECT_TRUE(std::equal(one.observed().begin(), one.observed().end(), many.observed().begin()));
}

TEST(SurfaceCoverage, BadInputIsRefused) {
  const PointCloud two = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_THROW(SurfaceCoverage({}, 0.1), std::invalid_argument);
  for (const double d_reg : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(SurfaceCoverage(two, d_reg), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
