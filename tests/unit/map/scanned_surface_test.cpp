#include "core/map/scanned_surface.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>

#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double radius = 0.005;

/// What a camera at the origin, that looks along z, sees of a plate one metre away: a point every 2 mm.
Scan plate(double left, double right) {
  Scan scan;
  for (int x = static_cast<int>(std::lround(left / 0.002)); x < static_cast<int>(std::lround(right / 0.002)); ++x)
    for (int y = -50; y < 50; ++y)
      scan.hits.emplace_back(static_cast<float>((x + 0.5) * 0.002), static_cast<float>((y + 0.5) * 0.002), 1.0f);
  return scan;
}
constexpr double pixel = 0.002 * 0.002;  // [sr] on the axis: each point is one of 2 x 2 mm, 1 m away

TEST(ScannedSurface, OfAPlateIsItsArea) {
  ScannedSurface surface(radius);
  // The area across the rays is the plate's, times the mean cosine: 0.2 m x 0.2 m, up to 0.14 m off the axis.
  EXPECT_NEAR(surface.add(plate(-0.1, 0.1), Vector3::UnitZ(), pixel), 0.04, 0.04 * 0.01);
  EXPECT_NEAR(surface.area(), 0.04, 0.0004);
  EXPECT_EQ(surface.add(plate(-0.1, 0.1), Vector3::UnitZ(), pixel), 0.0) << "nothing is new";
}

TEST(ScannedSurface, CellsComeInTheOrderOfTheirPlaces) {
  ScannedSurface forwards(radius), backwards(radius);
  Scan left = plate(-0.1, 0.0), right = plate(0.0, 0.1);
  for (Eigen::Vector3f& point : left.hits) point.z() += 0.02f * point.y();
  forwards.add(left, Vector3::UnitZ(), pixel), forwards.add(right, Vector3::UnitZ(), pixel);
  backwards.add(right, Vector3::UnitZ(), pixel), backwards.add(left, Vector3::UnitZ(), pixel);
  const auto cells = forwards.cells(), others = backwards.cells();
  ASSERT_GT(cells.size(), 1000u);
  ASSERT_EQ(cells.size(), others.size());
  const auto less = [](const ScannedSurface::Cell& a, const ScannedSurface::Cell& b) {
    return std::tuple(a.at.z(), a.at.y(), a.at.x()) < std::tuple(b.at.z(), b.at.y(), b.at.x());
  };
  EXPECT_TRUE(std::ranges::is_sorted(cells, less));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].at, others[i].at);
    EXPECT_EQ(cells[i].points, others[i].points);
  }
  const Eigen::Vector3i at(-1, 5, -7);
  EXPECT_EQ(ScannedSurface::order(at + Eigen::Vector3i(3, 0, 0)), ScannedSurface::order(at) + 3);
}

TEST(ScannedSurface, TheMiddleOfACellIsThatOfItsPoints) {
  std::mt19937_64 generator(5);
  for (int i = 0; i < 200; ++i) {
    // From a single point to all of them.
    const std::uint64_t points = i < 64    ? std::uint64_t{1} << i
                                 : i == 64 ? ~std::uint64_t{0}
                                           : generator() & generator();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (int place = 0; place < 64; ++place)
      if (points >> place & 1)
        sum += (Eigen::Vector3d(place % 4, place / 4 % 4, place / 16) + Eigen::Vector3d::Constant(0.5)) / 4.0, ++count;
    const Eigen::Vector3i at(-3, 0, 7);
    const Eigen::Vector3d middle = at.cast<double>() + sum / count;
    EXPECT_TRUE(ScannedSurface::Cell({at, points}).middle().cast<double>().isApprox(middle, 1e-6)) << points;
  }
}

TEST(ScannedSurface, PointsGetFewTowardsAnEdge) {
  ScannedSurface surface(radius);
  EXPECT_TRUE(surface.sparse_points(0.6).empty());
  surface.add(plate(-0.1, 0.1), Vector3::UnitZ(), pixel);
  std::size_t along_edges = 0;
  for (const Eigen::Vector3f& point : surface.sparse_points(0.6)) {
    const float inward = 0.1f - std::max(std::abs(point.x()), std::abs(point.y()));
    EXPECT_LT(inward, 0.5 * radius) << point.transpose();
    EXPECT_NEAR(point.z(), 1.0, 0.125 * radius + 1e-6) << "the middle of its place";
    ++along_edges;
  }
  // Half a disc holds so few points that rounding them to their places may take one to its other side.
  EXPECT_GE(along_edges, 330u) << "of the outermost 396 of 100 x 100 points";
  surface.add(plate(-0.2, 0.2), Vector3::UnitZ(), pixel);
  for (const Eigen::Vector3f& point : surface.sparse_points(0.6))
    EXPECT_TRUE(std::abs(point.y()) > 0.095f || std::abs(point.x()) > 0.195f) << "the edge has gone: " << point.x();
}

TEST(ScannedSurface, OnlyTheNewPartCounts) {
  ScannedSurface surface(radius);
  surface.add(plate(-0.1, 0.0), Vector3::UnitZ(), pixel);
  const double more = surface.add(plate(-0.1, 0.1), Vector3::UnitZ(), pixel);
  EXPECT_NEAR(more, 0.2 * (0.1 - radius), 0.2 * 0.0025) << "what is beside the seam is not new";
  EXPECT_NEAR(surface.area(), 0.04, 0.04 * 0.05);
}

TEST(ScannedSurface, DoesNotDependOnTheRange) {
  for (const double range : {0.5, 2.0}) {
    Scan scan = plate(-0.1, 0.1);  // the same pixels, of a plate as much larger as it is farther off
    for (Eigen::Vector3f& hit : scan.hits) hit *= static_cast<float>(range);
    ScannedSurface surface(radius);
    EXPECT_NEAR(surface.add(scan, Vector3::UnitZ(), pixel), 0.04 * range * range, 0.0005 * range * range);
  }
}

// By comparing all points: new is what is farther than the radius; within an eighth of it, and the rounding of both
// points to their sub-cells, it may be either.
TEST(ScannedSurface, AgreesWithComparingAllPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-0.06f, 0.06f);
  for (int round = 0; round < 20; ++round) {
    Scan first, second;
    for (int i = 0; i < 400; ++i) first.hits.emplace_back(uniform(random), uniform(random), uniform(random) * 0.1f);
    ScannedSurface surface(radius);
    surface.add(first, Vector3::UnitZ(), 1.0);
    for (int i = 0; i < 50; ++i) {
      second.hits = {Eigen::Vector3f(uniform(random), uniform(random), uniform(random) * 0.1f)};
      second.origin = second.hits[0].cast<double>() - Vector3::UnitZ();
      float nearest = 1e9f;
      for (const Eigen::Vector3f& p : first.hits) nearest = std::min(nearest, (p - second.hits[0]).norm());
      ScannedSurface copy = surface;
      const bool is_new = copy.add(second, Vector3::UnitZ(), 1.0) > 0.0;
      const double rounding = std::sqrt(3.0) * radius / 4;
      EXPECT_TRUE(is_new || nearest <= radius + rounding) << nearest;
      EXPECT_TRUE(!is_new || nearest >= radius - rounding) << nearest;
    }
  }
}

TEST(ScannedSurface, CopiesAreValues) {
  ScannedSurface surface(radius);
  surface.add(plate(-0.1, 0.0), Vector3::UnitZ(), pixel);
  ScannedSurface copy = surface;
  const double area = surface.area();
  EXPECT_GT(copy.add(plate(0.0, 0.1), Vector3::UnitZ(), pixel), 0.0);
  EXPECT_EQ(surface.area(), area);
  EXPECT_GT(surface.add(plate(0.0, 0.1), Vector3::UnitZ(), pixel), 0.0) << "the copy's points are not its own";
}

TEST(ScannedSurface, TheSameOnOneThreadAndTwo) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    std::mt19937 random(2);
    ScannedSurface surface(radius);
    for (int i = 0; i < 3; ++i)
      surface.add(random_scans::scan(random, Vector3(0.5, 0.1 * i, 0), 0.01, 20000), -Vector3::UnitX(), 1e-6);
    return surface.area();
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(ScannedSurface, AFileThatHasACellTwiceOrWhereNoneLooksForItIsRefused) {
  const std::uint64_t key = 1 + ScannedSurface::order(Eigen::Vector3i::Zero());
  const auto read = [&](std::initializer_list<std::size_t> slots) {
    std::vector<std::uint64_t> numbers(4096, 0);
    for (const std::size_t slot : slots) numbers[2 * slot] = key, numbers[2 * slot + 1] = 1;
    std::string bytes;
    ByteWriter writer([&](std::string_view some) { bytes += some; });
    writer(1.0, numbers);
    writer.finish();
    ByteReader reader(bytes);
    ScannedSurface surface(0.01);
    surface.archive(reader);
    return surface.cells().size();
  };
  std::size_t readable = 2048;  // the one slot where it is looked for
  for (std::size_t slot = 0; slot < 2048; ++slot) try {
      EXPECT_EQ(read({slot}), 1u);
      EXPECT_EQ(readable, 2048u) << "one alone";
      readable = slot;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "it holds no scanned surface");
    }
  ASSERT_LT(readable, 2047u);
  EXPECT_THROW(read({readable, readable + 1}), std::runtime_error) << "the second is never found";
}

TEST(ScannedSurface, PointsFarOffAndBadRadiiAreHarmless) {
  ScannedSurface surface(1e-6);
  Scan scan;
  scan.hits = {{1e30f, -1e30f, 0.0f}, {3e4f, 0.0f, 0.0f}};
  EXPECT_TRUE(std::isfinite(surface.add(scan, Vector3::UnitX(), 0.0)));
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(ScannedSurface{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace nextview
