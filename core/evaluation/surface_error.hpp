#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/evaluation/signed_distance.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/surface/surface.hpp"

namespace nextview {

struct SurfaceErrorOptions {
  std::vector<double> thresholds = {0.0005, 0.001, 0.002, 0.005, 0.01};  ///< [m], finite, at least 0
  std::size_t samples = 50'000;  ///< spread over the seen part of the reconstructed surface; over 0
  std::uint64_t seed = 1;        ///< of these samples
  /// Height of a plane that the object stands on [m]: what lies nearer to it than to the object is no surface of the
  /// object, and does not count.
  std::optional<double> ground = {};
};

/// What lies within a threshold: shares from 0 to 1.
struct ThresholdScore {
  double threshold = 0.0;             ///< [m]
  double accuracy = 0.0;              ///< of the seen reconstructed surface, within it of the true one
  double completeness_visible = 0.0;  ///< of the true surface that some candidate can see, within it of the seen
                                      ///< reconstructed one; NaN if none can be seen
  double completeness_all = 0.0;      ///< the same of all of the true surface
  double f_score = 0.0;               ///< harmonic mean of accuracy and completeness_visible; NaN likewise
};

/// The end of a scale: the smallest of 1, 2, 3 or 5 times a power of ten that is not below `length`, at least 0.00001
/// [m].
double scale_end(double length);

/// Bins of equal width from -limit to +limit; a value between two bins belongs to the upper one, +limit to the last.
struct DistanceHistogram {
  double limit = 0.0;               ///< [m] scale_end of what 99 % of the distances do not exceed
  std::vector<std::size_t> counts;  ///< one per bin
  std::size_t below = 0, above = 0;

  double lower(std::size_t bin) const { return limit * (2.0 * double(bin) / double(counts.size()) - 1.0); }  ///< [m]
};

/// How far a reconstructed surface lies from the true one. Distances are signed, positive outside of the true object.
/// Except for `at_vertices` they are taken at samples spread evenly by area over the seen part of the surface: the
/// triangles whose three corners are seen.
struct SurfaceError {
  std::vector<float> at_vertices;             ///< of each vertex, seen or not [m]
  double area_seen = 0.0, area_unseen = 0.0;  ///< of the reconstructed surface, without what is of the ground [m^2]
  double bias = 0.0;                          ///< mean of the signed distances [m]
  double rms = 0.0;                           ///< [m]
  /// Of distances without their sign: the smallest that at least so many percent of the samples do not exceed [m].
  double percentile_50 = 0.0, percentile_95 = 0.0, percentile_99 = 0.0, largest = 0.0;
  DistanceHistogram histogram;
  std::vector<ThresholdScore> scores;  ///< one per threshold, in the order given
};

/// Compares a surface with the true one. Completeness is taken at `samples`, samples of the true surface; `visible[i]`:
/// some candidate can see sample i. The same input gives the same bytes on any number of threads. None if no triangle
/// with an area is seen: there is nothing to compare.
/// @throws std::invalid_argument if there are no samples, `visible` is not as long, there is not for every vertex a
/// mark
///         whether it was seen, a threshold is below 0 or not finite, or there are no samples to be taken.
std::optional<SurfaceError> surface_error(const Surface& surface, const SignedDistance& truth,
                                          const SurfaceSamples& samples, std::span<const std::uint8_t> visible,
                                          const SurfaceErrorOptions& options = {});

}  // namespace nextview
