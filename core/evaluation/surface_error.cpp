#include "core/evaluation/surface_error.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/surface/seen_part.hpp"

namespace nextview {
namespace {

constexpr std::size_t bins = 50;
constexpr double smallest_scale = 1e-5;  // [m]

void check(const Surface& surface, const SurfaceSamples& samples, std::span<const std::uint8_t> visible,
           const SurfaceErrorOptions& options) {
  if (surface.seen.size() != surface.mesh.vertices.size())
    throw std::invalid_argument(fmt::format("surface error: {} vertices, but {} marks of seen",
                                            surface.mesh.vertices.size(), surface.seen.size()));
  if (samples.points.empty()) throw std::invalid_argument("surface error: there are no samples of the true surface");
  if (visible.size() != samples.points.size())
    throw std::invalid_argument(
        fmt::format("surface error: {} samples, but visibility for {}", samples.points.size(), visible.size()));
  if (options.samples == 0) throw std::invalid_argument("surface error: at least 1 sample must be taken");
  for (const double threshold : options.thresholds)
    if (!(threshold >= 0.0 && std::isfinite(threshold)))
      throw std::invalid_argument(fmt::format("surface error: a threshold must be at least 0 m, not {}", threshold));
}

template <class Value, class Measure>
std::vector<Value> measured(std::span<const Eigen::Vector3f> points, const Measure& measure) {
  std::vector<Value> values(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) values[i] = static_cast<Value>(measure(points[i]));
  });
  return values;
}

std::vector<double> sorted_magnitudes(std::span<const double> distances) {
  std::vector<double> sorted;
  for (const double d : distances) sorted.push_back(std::abs(d));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// NaN of none.
double share_within(double threshold, const std::vector<double>& sorted) {
  const auto within = std::upper_bound(sorted.begin(), sorted.end(), threshold) - sorted.begin();
  return double(within) / double(sorted.size());
}

double percentile(std::size_t percent, const std::vector<double>& sorted) {
  return sorted[(percent * sorted.size() + 99) / 100 - 1];
}

DistanceHistogram histogram_of(std::span<const double> distances, double limit) {
  DistanceHistogram histogram{limit, std::vector<std::size_t>(bins, 0)};
  for (const double d : distances) {
    if (d < -limit)
      ++histogram.below;
    else if (d > limit)
      ++histogram.above;
    else
      ++histogram.counts[std::min(std::size_t((d / limit + 1.0) / 2.0 * double(bins)), bins - 1)];
  }
  return histogram;
}

/// Everything that the distances of the samples say.
void summarise(std::span<const double> distances, const std::vector<double>& magnitudes, SurfaceError& result) {
  double sum = 0.0, squares = 0.0;
  for (const double d : distances) {
    sum += d;
    squares += d * d;
  }
  result.bias = sum / double(distances.size());
  result.rms = std::sqrt(squares / double(distances.size()));
  result.percentile_50 = percentile(50, magnitudes);
  result.percentile_95 = percentile(95, magnitudes);
  result.percentile_99 = percentile(99, magnitudes);
  result.largest = magnitudes.back();
  result.histogram = histogram_of(distances, scale_end(result.percentile_99));
}

/// The triangles that count, as their corners do.
TriangleMesh seen_of_object(const Surface& surface, const std::vector<float>& distances, std::optional<double> ground) {
  if (!ground) return seen_part(surface);
  Surface object = surface;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (std::abs(surface.mesh.vertices[i].z() - *ground) < std::abs(distances[i])) object.seen[i] = 0;
  return seen_part(object);
}

}  // namespace

double scale_end(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(length, smallest_scale)) + 1e-9));
  for (const double factor : {1.0, 2.0, 3.0, 5.0})
    if (length <= factor * power * (1.0 + 1e-9)) return factor * power;
  return 10.0 * power;
}

std::optional<SurfaceError> surface_error(const Surface& surface, const SignedDistance& truth,
                                          const SurfaceSamples& samples, std::span<const std::uint8_t> visible,
                                          const SurfaceErrorOptions& options) {
  check(surface, samples, visible, options);
  SurfaceError result;
  result.at_vertices = measured<float>(surface.mesh.vertices, truth);
  const TriangleMesh seen = seen_of_object(surface, result.at_vertices, options.ground);
  result.area_seen = seen.surface_area();
  if (!(result.area_seen > 0.0)) return std::nullopt;
  const double with_ground = options.ground ? seen_part(surface).surface_area() : result.area_seen;
  result.area_unseen = surface.mesh.surface_area() - with_ground;

  const auto taken = sample_surface(seen, options.samples, options.seed);
  const std::vector<double> distances = measured<double>(taken.points, truth);
  const std::vector<double> accuracies = sorted_magnitudes(distances);
  summarise(distances, accuracies, result);

  const std::vector<double> of_truth = measured<double>(samples.points, MeshDistance(seen));
  std::vector<double> of_visible;
  for (std::size_t i = 0; i < visible.size(); ++i)
    if (visible[i]) of_visible.push_back(of_truth[i]);
  const std::vector<double> all = sorted_magnitudes(of_truth), seeable = sorted_magnitudes(of_visible);
  for (const double t : options.thresholds) {
    ThresholdScore score{t, share_within(t, accuracies), share_within(t, seeable), share_within(t, all)};
    const double sum = score.accuracy + score.completeness_visible;
    score.f_score = sum > 0.0 ? 2.0 * score.accuracy * score.completeness_visible / sum : sum;
    result.scores.push_back(score);
  }
  return result;
}

}  // namespace nextview
