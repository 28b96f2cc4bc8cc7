#include "core/evaluation/surface_error.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "tests/unit/evaluation/distance_oracle.hpp"
#include "tests/unit/evaluation/surface_error_of.hpp"
#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

/// The distance of the plane of the sphere's nearest face from its centre, as a share of its radius.
double flattest_face(const TriangleMesh& sphere, double radius) {
  double nearest = radius;
  for (const auto& [a, b, c] : sphere.triangles) {
    const Vector3 origin = sphere.vertices[a].cast<double>();
    const Vector3 normal =
        (sphere.vertices[b].cast<double>() - origin).cross(sphere.vertices[c].cast<double>() - origin).normalized();
    nearest = std::min(nearest, normal.dot(origin));
  }
  return nearest / radius;
}

TEST(SurfaceError, ofConcentricSpheresIsTheDifferenceOfTheirRadii) {
  constexpr double radius = 0.1;
  const TriangleMesh truth = closed_meshes::sphere(Vector3::Zero(), radius, 5);
  // The surface is the true one made larger or smaller, so every face lies off its own by the offset times its plane's
  // distance from the centre over the radius, and nothing lies off by less or by more than the offset.
  const double least = flattest_face(truth, radius);
  ASSERT_GT(least, 0.999);
  for (const double offset : {2 * mm, -2 * mm}) {
    const TriangleMesh mesh = closed_meshes::sphere(Vector3::Zero(), radius + offset, 5);
    const SurfaceError result = surface_error_of(seen_surface(mesh), truth);
    const double sign = offset > 0 ? 1.0 : -1.0, tolerance = 1e-7;
    for (const double distance : {sign * result.bias, result.rms, result.percentile_50, result.percentile_95,
                                  result.percentile_99, result.largest}) {
      EXPECT_GE(distance, least * 2 * mm - tolerance);
      EXPECT_LE(distance, 2 * mm + tolerance);
    }
    for (const float distance : result.at_vertices) ASSERT_NEAR(distance, offset, (1 - least) * 2 * mm + tolerance);
    EXPECT_DOUBLE_EQ(result.area_seen, mesh.surface_area());
    EXPECT_EQ(result.area_unseen, 0.0);
    ASSERT_EQ(result.scores.size(), 5u);
    for (const ThresholdScore& score : result.scores) {
      const double expected = score.threshold >= 2.5 * mm ? 1.0 : 0.0;
      if (score.threshold == 2 * mm) continue;  // rounding decides
      EXPECT_EQ(score.accuracy, expected) << score.threshold;
      EXPECT_EQ(score.completeness_all, expected);
      EXPECT_EQ(score.completeness_visible, expected);
      EXPECT_EQ(score.f_score, expected);
    }
  }
}

TEST(SurfaceError, ofABoxGrownByAMillimetre) {
  const Vector3 half(0.05, 0.03, 0.02);
  const TriangleMesh truth = closed_meshes::box(-half, half);
  const Vector3 grown = half + Vector3::Constant(1 * mm), shrunk = half - Vector3::Constant(1 * mm);
  const auto area = [](const Vector3& h) { return 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x()); };
  const SurfaceErrorOptions options{.thresholds = {0.9 * mm, 1.0001 * mm, 1.75 * mm}};
  const SurfaceError larger = surface_error_of(seen_surface(closed_meshes::box(-grown, grown)), truth, options);
  EXPECT_NEAR(larger.percentile_50, 1 * mm, 1e-8);
  EXPECT_NEAR(larger.area_seen, area(grown), 1e-8);
  EXPECT_EQ(larger.scores[0].accuracy, 0.0);
  // All but its rims lies 1 mm above the true faces; its corners lie the root of 3 mm off.
  EXPECT_NEAR(larger.scores[1].accuracy, area(half) / area(grown), 2e-3);
  EXPECT_EQ(larger.scores[2].accuracy, 1.0);
  EXPECT_LE(larger.largest, std::sqrt(3.0) * mm + 1e-8);
  EXPECT_EQ(larger.scores[0].completeness_all, 0.0);
  EXPECT_EQ(larger.scores[1].completeness_all, 1.0);

  const SurfaceError smaller = surface_error_of(seen_surface(closed_meshes::box(-shrunk, shrunk)), truth, options);
  EXPECT_NEAR(smaller.bias, -1 * mm, 1e-8);
  EXPECT_NEAR(smaller.rms, 1 * mm, 1e-8);
  EXPECT_NEAR(smaller.largest, 1 * mm, 1e-8);
  EXPECT_EQ(smaller.scores[1].accuracy, 1.0);
  EXPECT_NEAR(smaller.scores[1].completeness_all, area(shrunk) / area(half), 3e-3);
  const double completeness = smaller.scores[1].completeness_visible;
  EXPECT_DOUBLE_EQ(smaller.scores[1].f_score, 2 * completeness / (1 + completeness));
}

TEST(SurfaceError, ofHalfASphereFindsHalfOfIt) {
  const TriangleMesh sphere = closed_meshes::sphere(Vector3::Zero(), 0.1, 4);
  Surface surface = seen_surface(sphere);
  for (std::size_t i = 0; i < surface.seen.size(); ++i) surface.seen[i] = sphere.vertices[i].z() > -1e-6f;
  const SurfaceSamples samples = sample_surface(sphere, 20'000, 3);
  std::vector<std::uint8_t> upper, lower;
  for (const Eigen::Vector3f& p : samples.points) {
    upper.push_back(p.z() > 0.0f);
    lower.push_back(p.z() < -0.002f);
  }
  const SurfaceErrorOptions options{.thresholds = {0.1 * mm}};
  const SignedDistance truth(sphere);
  const auto of_upper = surface_error(surface, truth, samples, upper, options);
  const auto of_lower = surface_error(surface, truth, samples, lower, options);
  EXPECT_NEAR(of_upper->area_seen, of_upper->area_unseen, 1e-9);
  EXPECT_EQ(of_upper->scores[0].accuracy, 1.0);
  EXPECT_NEAR(of_upper->scores[0].completeness_all, 0.5, 2e-3);
  EXPECT_EQ(of_upper->scores[0].completeness_visible, 1.0);
  EXPECT_EQ(of_upper->scores[0].f_score, 1.0);
  EXPECT_EQ(of_lower->scores[0].completeness_visible, 0.0);
  EXPECT_EQ(of_lower->scores[0].f_score, 0.0);
  EXPECT_EQ(of_lower->scores[0].completeness_all, of_upper->scores[0].completeness_all);
}

/// A closed blob with bumps, and a surface about it that wobbles, part of it not seen.
struct Blobs {
  TriangleMesh truth;
  Surface surface;
};
Blobs random_blobs(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> wobble(0.7f, 1.3f), offset(0.95f, 1.06f);
  Blobs blobs{closed_meshes::sphere(Vector3::Zero(), 0.1, 2), {}};
  for (auto& v : blobs.truth.vertices) v *= wobble(generator);
  TriangleMesh mesh = blobs.truth;
  for (auto& v : mesh.vertices) v *= offset(generator);
  blobs.surface = seen_surface(mesh);
  for (auto& seen : blobs.surface.seen) seen = wobble(generator) < 1.2f;
  return blobs;
}

TEST(SurfaceError, agreesWithEveryTriangleTriedInTurn) {
  for (const unsigned seed : {1u, 2u}) {
    const auto& [truth, surface] = random_blobs(seed);
    const SurfaceErrorOptions options{.thresholds = {1 * mm, 3 * mm, 0.0, 1.0}, .samples = 300, .seed = seed};
    const SurfaceSamples samples = sample_surface(truth, 257, seed);
    std::vector<std::uint8_t> visible;
    for (const auto& p : samples.points) visible.push_back(p.x() > 0.0f);
    const SurfaceError result = surface_error(surface, SignedDistance(truth), samples, visible, options).value();

    for (std::size_t i = 0; i < surface.mesh.vertices.size(); ++i)
      ASSERT_NEAR(result.at_vertices[i],
                  distance_oracle::signed_distance(surface.mesh.vertices[i].cast<double>(), truth), 1e-7);
    TriangleMesh seen = surface.mesh;
    std::erase_if(seen.triangles, [&](const std::array<std::uint32_t, 3>& t) {
      return surface.seen[t[0]] + surface.seen[t[1]] + surface.seen[t[2]] != 3;
    });
    EXPECT_NEAR(result.area_seen, seen.surface_area(), 1e-12);
    EXPECT_NEAR(result.area_seen + result.area_unseen, surface.mesh.surface_area(), 1e-12);

    double sum = 0.0, squares = 0.0;
    std::vector<double> magnitudes;
    for (const auto& p : sample_surface(seen, options.samples, seed).points) {
      const double d = distance_oracle::signed_distance(p.cast<double>(), truth);
      sum += d;
      squares += d * d;
      magnitudes.push_back(std::abs(d));
    }
    std::sort(magnitudes.begin(), magnitudes.end());
    EXPECT_NEAR(result.bias, sum / 300, 1e-7);
    EXPECT_NEAR(result.rms, std::sqrt(squares / 300), 1e-7);
    EXPECT_NEAR(result.percentile_50, magnitudes[149], 1e-7);  // 150 of 300 are 50 %
    EXPECT_NEAR(result.percentile_95, magnitudes[284], 1e-7);
    EXPECT_NEAR(result.percentile_99, magnitudes[296], 1e-7);
    EXPECT_NEAR(result.largest, magnitudes[299], 1e-7);
    for (const ThresholdScore& score : result.scores) {
      double within = 0, all = 0, of_visible = 0, count_visible = 0;
      for (const double d : magnitudes) within += d <= score.threshold;
      for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const bool hit = distance_oracle::unsigned_distance(samples.points[i].cast<double>(), seen) <= score.threshold;
        all += hit;
        of_visible += hit && visible[i];
        count_visible += visible[i];
      }
      EXPECT_DOUBLE_EQ(score.accuracy, within / 300);
      EXPECT_DOUBLE_EQ(score.completeness_all, all / 257);
      EXPECT_DOUBLE_EQ(score.completeness_visible, of_visible / count_visible);
    }
  }
}

TEST(SurfaceError, isTheSameOnAnyNumberOfThreads) {
  const auto& [truth, surface] = random_blobs(5);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return surface_error_of(surface, truth);
  };
  const SurfaceError one = run(1), four = run(4);
  EXPECT_EQ(one.at_vertices, four.at_vertices);
  EXPECT_EQ(one.bias, four.bias);
  EXPECT_EQ(one.rms, four.rms);
  EXPECT_EQ(one.largest, four.largest);
  EXPECT_EQ(one.histogram.counts, four.histogram.counts);
  for (std::size_t i = 0; i < one.scores.size(); ++i) {
    EXPECT_EQ(one.scores[i].accuracy, four.scores[i].accuracy);
    EXPECT_EQ(one.scores[i].completeness_all, four.scores[i].completeness_all);
  }
}

TEST(SurfaceError, ofNothingSeenIsNone) {
  const TriangleMesh sphere = closed_meshes::sphere(Vector3::Zero(), 0.1, 2);
  const SignedDistance truth(sphere);
  const SurfaceSamples samples = sample_surface(sphere, 100, 1);
  const std::vector<std::uint8_t> none(100, 0);
  Surface surface = seen_surface(sphere);
  const auto nothing_visible = surface_error(surface, truth, samples, none);
  ASSERT_TRUE(nothing_visible);
  EXPECT_TRUE(std::isnan(nothing_visible->scores[0].completeness_visible));
  EXPECT_TRUE(std::isnan(nothing_visible->scores[0].f_score));
  EXPECT_EQ(nothing_visible->scores[0].completeness_all, 1.0);

  EXPECT_FALSE(surface_error({}, truth, samples, none));
  surface.seen.assign(surface.seen.size(), 0);
  EXPECT_FALSE(surface_error(surface, truth, samples, none));
  surface.seen[0] = surface.seen[1] = 1;  // two corners do not make a triangle
  EXPECT_FALSE(surface_error(surface, truth, samples, none));
}

TEST(SurfaceError, refusesWhatDoesNotFit) {
  const TriangleMesh sphere = closed_meshes::sphere(Vector3::Zero(), 0.1, 1);
  const SignedDistance truth(sphere);
  const SurfaceSamples samples = sample_surface(sphere, 100, 1);
  const std::vector<std::uint8_t> visible(100, 1), too_few(99, 1);
  Surface surface = seen_surface(sphere);
  EXPECT_THROW(surface_error(surface, truth, {}, {}), std::invalid_argument);
  EXPECT_THROW(surface_error(surface, truth, samples, too_few), std::invalid_argument);
  EXPECT_THROW(surface_error(surface, truth, samples, visible, {.samples = 0}), std::invalid_argument);
  for (const double threshold : {-1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(surface_error(surface, truth, samples, visible, {.thresholds = {threshold}}), std::invalid_argument);
  surface.seen.pop_back();
  EXPECT_THROW(surface_error(surface, truth, samples, visible), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
