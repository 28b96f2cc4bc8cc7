// Clouds that no surface can be made of, odd arguments, and stopping.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/surface/cloud_surface.hpp"
#include "tests/unit/surface/made_scans.hpp"
#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using made_scans::views_of_sphere;
using surface_checks::complete;

constexpr double finest = 0.003;  // [m]

Scan scan_of(PointCloud points) {
  Scan scan;
  scan.origin = {0, 0, 1};
  scan.hits = std::move(points);
  return scan;
}

void expect_empty_with_reason(const Surface& surface) {
  EXPECT_TRUE(surface.mesh.triangles.empty());
  EXPECT_TRUE(surface.mesh.vertices.empty());
  EXPECT_TRUE(surface.uncertainty.empty());
  EXPECT_TRUE(surface.seen.empty());
  EXPECT_FALSE(surface.why_empty.empty());
}

std::vector<Scan> scanned_sphere() { return views_of_sphere(0.1, {.pitch = 0.003, .half_width = 40}, true, 1); }

TEST(CloudSurfaceEdge, TooFewPointsAreEmptyWithTheReason) {
  expect_empty_with_reason(cloud_surface({}, finest));
  expect_empty_with_reason(cloud_surface(std::vector<Scan>(3), finest));
  expect_empty_with_reason(cloud_surface(std::vector<Scan>{scan_of({{0, 0, 0}})}, finest));
  expect_empty_with_reason(
      cloud_surface(std::vector<Scan>{scan_of({{0, 0, 0}, {0.001f, 0, 0}, {0, 0.001f, 0}})}, finest));
}

TEST(CloudSurfaceEdge, PointsThatAreAllEqualAreEmptyWithTheReason) {
  expect_empty_with_reason(cloud_surface(std::vector<Scan>{scan_of(PointCloud(500, {0.1f, 0.2f, 0.3f}))}, finest));
  expect_empty_with_reason(cloud_surface(std::vector<Scan>{scan_of(PointCloud(500, {0, 0, 1}))}, finest));
}

TEST(CloudSurfaceEdge, PointsOnALineAreSound) {
  PointCloud line;
  for (int i = 0; i < 2000; ++i) line.emplace_back(0.0001f * float(i), 0.0f, 0.0f);
  const Surface surface = cloud_surface(std::vector<Scan>{scan_of(line)}, finest);
  EXPECT_TRUE(complete(surface, 1.0)) << "a thin strip or nothing";
  EXPECT_TRUE(surface_checks::indices_valid(surface.mesh));
}

/// Whether a sphere's scans with one more point give the sphere, of this area, or are refused.
bool sound_with(const Eigen::Vector3f& point, bool first, double area) {
  auto scans = scanned_sphere();
  auto& points = scans[first ? 0 : 3].hits;
  points.insert(first ? points.begin() : points.end(), point);
  try {
    const Surface surface = cloud_surface(scans, finest);
    return complete(surface, 0.01) && surface_checks::indices_valid(surface.mesh) &&
           std::abs(surface.mesh.surface_area() / area - 1.0) < 0.01;
  } catch (const std::invalid_argument& error) {
    return std::string(error.what()).find('\n') == std::string::npos;
  }
}

/// How many points without numbers are not dealt with soundly.
int unsound_points(bool first) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const double area = cloud_surface(scanned_sphere(), finest).mesh.surface_area();
  int unsound = 0;
  for (const Eigen::Vector3f& point : {Eigen::Vector3f(nan, nan, nan), {0.1f, nan, 0.0f}, {inf, 0, 0}, {0, -inf, 0}})
    unsound += !sound_with(point, first, area);
  return unsound;
}

// In processes of their own: they may not end the program.
TEST(CloudSurfaceEdge, PointsThatAreNoNumbersAreRefusedOrLeftOut) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(std::_Exit(unsound_points(true)), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(std::_Exit(unsound_points(false)), testing::ExitedWithCode(0), "");
}

TEST(CloudSurfaceEdge, AStrayPointAKilometreAwayIsRefused) {
  auto scans = scanned_sphere();
  scans[2].hits.emplace_back(0.0f, 1000.0f, 0.0f);
  try {
    cloud_surface(scans, finest);
    ADD_FAILURE() << "made a surface";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("apart"));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
  scans[2].hits.back() = {700.0f, 1000.0f, -800.0f};
  EXPECT_THROW(cloud_surface(scans, finest), std::invalid_argument);
}

TEST(CloudSurfaceEdge, CellsThatAreNotOverZeroAreRefused) {
  for (const double cell : {0.0, -0.0, -0.001, double(NAN)}) {
    EXPECT_THROW(cloud_surface(scanned_sphere(), cell), std::invalid_argument) << cell;
    EXPECT_THROW(cloud_surface({}, cell), std::invalid_argument) << cell;
  }
}

TEST(CloudSurfaceEdge, HugeCellsAreEmptyWithTheReasonOrRefused) {
  for (const double cell : {1.0, 1e6, 1e30, double(INFINITY)}) {
    try {
      expect_empty_with_reason(cloud_surface(scanned_sphere(), cell));
    } catch (const std::invalid_argument&) {
    }
  }
}

TEST(CloudSurfaceEdge, TinyCellsAreAsWideAsThePixels) {
  const Surface surface = cloud_surface(scanned_sphere(), 1e-6);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  EXPECT_TRUE(complete(surface, 0.01));
  EXPECT_LT(surface.mesh.vertices.size(), 200'000u);
}

TEST(CloudSurfaceEdge, StopsAtEveryStepAndIsEmptyThen) {
  int steps = 0;
  double last = -1.0;
  const auto count = [&](double fraction, std::string_view what) {
    EXPECT_GT(fraction, last);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(what.empty());
    last = fraction;
    ++steps;
  };
  ASSERT_FALSE(cloud_surface(scanned_sphere(), finest, count).empty());
  ASSERT_GT(steps, 2);
  for (int at = 0; at < steps; ++at) {
    std::stop_source source;
    int step = 0;
    const auto stop_there = [&](double, std::string_view) {
      if (step++ == at) source.request_stop();
    };
    SCOPED_TRACE(at);
    expect_empty_with_reason(cloud_surface(scanned_sphere(), finest, stop_there, source.get_token()));
  }
}

TEST(CloudSurfaceEdge, StoppedBeforeItBeganIsEmpty) {
  std::stop_source source;
  source.request_stop();
  expect_empty_with_reason(cloud_surface(scanned_sphere(), finest, {}, source.get_token()));
}

}  // namespace
}  // namespace nextview
