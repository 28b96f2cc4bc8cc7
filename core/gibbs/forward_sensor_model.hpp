#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/gibbs/range_measurements.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/setting/setting.hpp"

namespace nextview {

/// p(z | f) of a range given the map along its ray.
enum class ForwardModel {
  paper,       ///< Eq. 1 as printed: the weights eta inside the exponent, no floor for outliers
  cone,        ///< Eq. 2 (Pathak et al. 2007): no density, it tends to 0.5 far behind the surface
  beam,        ///< the mixture of Thrun et al. 2005: hit, random, maximum
  attenuation  ///< partly filled voxels: some rays end in them, others pass
};
constexpr std::string_view name(ForwardModel model) {
  constexpr std::string_view names[] = {"paper", "cone", "beam", "attenuation"};
  return names[static_cast<std::size_t>(model)];
}

/// What stands for the range of a voxel: the mean of the Gaussian over the ray's entry-exit segment, or the distance of
/// the voxel's centre from the camera, as in the paper. With centres sigma is taken as it is: what the voxel's own size
/// adds, sqrt(sigma^2 + edge^2 / 12), is for the caller to say.
enum class VoxelRange { segment, centre };

/// A voxel on the ray of a measurement.
struct VoxelSegment {
  std::uint32_t voxel = 0;
  double enter = 0.0, exit = 0.0;  ///< distances from the camera [m]
};

/// A forward sensor model with its parameters. Voxels have levels: 0 is free; `paper`, `cone` and `beam` know one level
/// more, occupied; `attenuation` one for each of its strengths.
struct ForwardSensorModel {
  static constexpr int max_attenuations = 5;

  ForwardModel kind = ForwardModel::attenuation;
  VoxelRange voxel_range = VoxelRange::segment;
  double sigma = 0.002;          ///< of the range [m]
  double angular_sigma = 0.001;  ///< cone: of azimuth and altitude [rad]; half the angular pitch of the rays
  double random_weight = 0.05;   ///< beam, attenuation: share of ranges that come from anywhere
  double max_weight = 0.05;      ///< ... of rays that miss a surface they should have met
  double eta_hit = 1.0;          ///< paper: the weight inside the exponent of Eq. 1
  /// attenuation: kappa of each level, ascending [1 / voxel edge]. Weak levels, as a surface that touches a voxel
  /// mostly fills little of it: with strong ones a voxel that stops half of its rays makes its neighbours look free.
  std::vector<double> attenuations = {0.05, 0.2};
  /// A power of the likelihood: what log p(z | m) of each ray counts. 1: rays err independently of each other. Less, as
  /// neighbouring rays of a dense image are not independent witnesses of how full a voxel is. 0: from how dense the
  /// rays are, see with_independence.
  double independence = 1.0;

  /// @throws std::invalid_argument naming the setting and its bounds.
  void validate() const;

  int levels() const { return kind == ForwardModel::attenuation ? 1 + static_cast<int>(attenuations.size()) : 2; }
  double hit_weight() const { return 1.0 - random_weight - max_weight; }
  bool is_first_hit() const { return kind == ForwardModel::paper || kind == ForwardModel::cone; }
  /// Share of light that passes a voxel of this level along a chord [voxel edges]. A beam ends in the first occupied
  /// voxel.
  double transmission(int level, double chord) const;
};
/// Without those that come from elsewhere: sigmas, attenuations and the independence.
std::vector<Setting> settings(ForwardSensorModel& model);

/// How far a measurement depends on voxels [m]: up to 4 sigma behind its range, or to the maximum range.
double list_end(const RangeMeasurements& measurements, const RangeMeasurement& ray, const ForwardSensorModel& model);

/// The voxels that a measurement depends on, in order.
std::vector<VoxelSegment> ray_segments(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                       const RangeMeasurement& ray, const ForwardSensorModel& model);

/// Density of a range `z` [m] given that the ray ended in this voxel [1/m] (beam, attenuation).
double hit_density(const VoxelGrid& grid, const ForwardSensorModel& model, const Vector3& origin,
                   const VoxelSegment& segment, double z);

/// log p(z | f) of a first-hit model (paper, cone), f being the voxel; without a voxel, nothing is occupied on the ray.
/// `z` [m]; for a ray beyond range it is z_max (our reading, the paper is silent).
double first_hit_log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const Vector3& origin,
                                const Vector3& direction, const VoxelSegment* segment, double z, double max_range);

/// log p(z | m): the definition, term by term, for one measured ray (neither its weight nor the independence counted).
/// `levels` has one entry a voxel of the grid. The sampler gets the same numbers from state that it keeps.
double log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const RangeMeasurements& measurements,
                      const RangeMeasurement& ray, std::span<const std::uint8_t> levels);
/// The same, for who has the ray's ray_segments already.
double log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const RangeMeasurements& measurements,
                      const RangeMeasurement& ray, std::span<const VoxelSegment> segments,
                      std::span<const std::uint8_t> levels);

}  // namespace nextview
