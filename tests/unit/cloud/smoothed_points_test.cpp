#include "core/cloud/smoothed_points.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <random>

namespace nextview {
namespace {

constexpr double noise = 0.005, pitch = 0.002;  // [m], and of the pixels at depth 1
const Smoothing smoothing = Smoothing::down_to(0.01, noise, pitch* pitch);

/// What a camera 0.2 m above the origin, turned half round, sees where its ray through (x, y) at depth 1 ends at a
/// depth of `depth(x, y)`, with noise along the ray.
struct NoisyScan {
  Pose T_world_camera = Pose(Eigen::Translation3d(0.0, 0.0, 0.2) * Eigen::AngleAxisd(3.0, Vector3(0.6, 0.8, 0.0)));
  Scan scan;

  explicit NoisyScan(const std::function<double(double, double)>& depth, double deviation = noise) {
    std::mt19937 random(4);
    std::normal_distribution<double> normal(0.0, deviation);
    scan.origin = T_world_camera.translation();
    for (int row = -40; row < 40; ++row)
      for (int column = -40; column < 40; ++column) {
        const Vector3 on_plane(pitch * column, pitch * row, 1.0);
        const double range =
            depth(on_plane.x(), on_plane.y()) * on_plane.norm() + (deviation > 0.0 ? normal(random) : 0.0);
        scan.hits.push_back((T_world_camera * (range * on_plane.normalized())).cast<float>());
      }
  }
  /// Of a point, in the camera's frame.
  Vector3 in_camera(const Eigen::Vector3f& point) const { return T_world_camera.inverse() * point.cast<double>(); }
};

double slanted_plane(double x, double) { return 1.0 / (1.0 + x); }  // 45 degrees
/// How far a point of the camera's frame lies behind the slanted plane, along its ray.
double behind_plane(const Vector3& p) { return p.norm() - slanted_plane(p.x() / p.z(), 0.0) * p.norm() / p.z(); }

TEST(SmoothedPoints, LieOnASlantedPlane) {
  const NoisyScan noisy(slanted_plane);
  const PointCloud smoothed = smoothed_points(noisy.scan, noisy.T_world_camera, smoothing);
  ASSERT_EQ(smoothed.size(), noisy.scan.hits.size());
  double sum = 0.0, squares = 0.0;
  for (const Eigen::Vector3f& point : smoothed) {
    const double off = behind_plane(noisy.in_camera(point));
    sum += off, squares += off * off;
  }
  const double count = double(smoothed.size());
  EXPECT_NEAR(sum / count, 0.0, 0.0003) << "neither before it nor behind it";
  // A sixth of what was wanted, but for the rim of the image, where a plane is fitted to fewer.
  EXPECT_LT(std::sqrt(squares / count), 0.01 / 6.0 * 1.1);
  EXPECT_GT(std::sqrt(squares / count), 0.01 / 6.0 * 0.5);
}

TEST(SmoothedPoints, StayOnTheirRaysInTheirOrder) {
  const NoisyScan noisy(slanted_plane);
  const PointCloud smoothed = smoothed_points(noisy.scan, noisy.T_world_camera, smoothing);
  ASSERT_EQ(smoothed.size(), noisy.scan.hits.size());
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const Vector3 before = noisy.in_camera(noisy.scan.hits[i]).normalized(), after = noisy.in_camera(smoothed[i]);
    ASSERT_NEAR(before.dot(after.normalized()), 1.0, 1e-9) << i;
  }
}

TEST(SmoothedPoints, OfAPlaneWithoutNoiseStay) {
  const NoisyScan exact(slanted_plane, 0.0);
  const PointCloud smoothed = smoothed_points(exact.scan, exact.T_world_camera, smoothing);
  ASSERT_EQ(smoothed.size(), exact.scan.hits.size());
  for (std::size_t i = 0; i < smoothed.size(); ++i)
    ASSERT_LT((smoothed[i] - exact.scan.hits[i]).norm(), 2e-5f) << i;  // what a plane bends in ranges
}

TEST(SmoothedPoints, KeepAStep) {
  const auto step = [](double x, double) { return x < 0.0 ? 1.0 : 1.06; };
  const NoisyScan noisy(step);
  const PointCloud smoothed = smoothed_points(noisy.scan, noisy.T_world_camera, smoothing);
  ASSERT_EQ(smoothed.size(), noisy.scan.hits.size());
  for (const Eigen::Vector3f& point : smoothed) {
    const Vector3 p = noisy.in_camera(point);
    ASSERT_NEAR(p.z(), step(p.x() / p.z() + 1e-6, 0.0), 4.0 * noise) << p.transpose();
  }
}

TEST(SmoothedPoints, AloneOrBehindTheCameraStay) {
  Scan scan;
  scan.hits = {{0.0f, 0.0f, 1.0f}, {0.5f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
  EXPECT_EQ(smoothed_points(scan, Pose::Identity(), smoothing), scan.hits);
  scan.hits = {{7.0f, 0.0f, 1.0f}, {7.0f, 0.0f, 1.001f}};  // 82 degrees off the axis
  EXPECT_EQ(smoothed_points(scan, Pose::Identity(), smoothing), scan.hits);
  EXPECT_TRUE(smoothed_points({}, Pose::Identity(), smoothing).empty());
}

TEST(SmoothedPoints, AreNoMoreThanIsAffordable) {
  const double most = Smoothing::down_to(1e-9, 1.0, pitch * pitch).half_window;
  EXPECT_NEAR(most, Smoothing::down_to(Smoothing::least(1.0), 1.0, pitch * pitch).half_window, 1e-12);
  EXPECT_LT(most, 15 * pitch);
  const NoisyScan noisy(slanted_plane);
  EXPECT_EQ(smoothed_points(noisy.scan, noisy.T_world_camera, {noise, 0.0}), noisy.scan.hits);
}

TEST(SmoothedPoints, TheSameOnOneThreadAndTwo) {
  const NoisyScan noisy(slanted_plane);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return smoothed_points(noisy.scan, noisy.T_world_camera, smoothing);
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace nextview
