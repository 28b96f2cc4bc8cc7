#include "core/gibbs/forward_sensor_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

double normal_density(double x, double sigma) {
  const double u = x / sigma;
  return std::exp(-0.5 * u * u) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// Probability of a standard normal between a and b.
double normal_interval(double a, double b) {
  return 0.5 * (std::erfc(-b / std::numbers::sqrt2) - std::erfc(-a / std::numbers::sqrt2));
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

/// Eq. 2's angles: of the voxel's centre about the ray, in the two directions across it.
double squared_angular_offset(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction,
                              std::uint32_t voxel) {
  const Vector3 to_centre = grid.centre(voxel) - origin;
  const double angle = std::atan2(direction.cross(to_centre).norm(), direction.dot(to_centre));
  return angle * angle;  // azimuth and altitude have one sigma, so their squares add up to this
}

/// log of Eq. 2. `range` is the voxel's; `offset` the sum of both squared angles over sigma^2.
double log_cone(double z, double range, double sigma, double offset) {
  const double x = 2.0 * ((z - range) + 2.0 * sigma) / sigma + offset;
  const double d = (z - range) / sigma;
  // log(1/2 / (1 + e^-x) + 1/3 e^-(d^2 + offset)), without leaving the logarithms: far ranges underflow.
  const double behind = std::log(0.5) - (x > 0.0 ? std::log1p(std::exp(-x)) : std::log1p(std::exp(x)) - x);
  const double at = -std::log(3.0) - (d * d + offset);
  const double larger = std::max(behind, at);
  return larger + std::log1p(std::exp(std::min(behind, at) - larger));
}

}  // namespace

std::vector<Setting> settings(ForwardSensorModel& m) {
  return {
      {"gibbs.model", "", "forward sensor model", choice(m.kind, {"paper", "cone", "beam", "attenuation"})},
      {"gibbs.voxel_range", "", "range of a voxel: over the ray's segment in it, or its centre's",
       choice(m.voxel_range, {"segment", "centre"})},
      {"gibbs.random_weight", "", "beam, attenuation: share of ranges that come from anywhere", &m.random_weight,
       between(0, 1)},
      {"gibbs.max_weight", "", "beam, attenuation: share of rays that miss a surface they met", &m.max_weight,
       between(0, 1)},
      {"gibbs.eta_hit", "", "paper: weight inside the exponent of Eq. 1", &m.eta_hit, over_to(0, 1000)},
  };
}

void ForwardSensorModel::validate() const {
  require_in_bounds(*this);
  require(sigma > 0.0 && std::isfinite(sigma), fmt::format("gibbs.sigma must be over 0, not {}", sigma));
  require(angular_sigma > 0.0 && std::isfinite(angular_sigma),
          fmt::format("gibbs.angular_sigma must be over 0, not {}", angular_sigma));
  require(hit_weight() > 0.0, fmt::format("gibbs.random_weight, {}, and gibbs.max_weight, {}, must leave something for "
                                          "hits: together they must be below 1",
                                          random_weight, max_weight));
  require(independence >= 0.0 && independence <= 1.0,
          fmt::format("gibbs.independence must be from 0 to 1, not {}", independence));
  require(!attenuations.empty() && attenuations.size() <= max_attenuations && attenuations.front() > 0.0 &&
              attenuations.back() <= 50.0 && std::is_sorted(attenuations.begin(), attenuations.end()),
          fmt::format("gibbs.attenuations must be one to {} ascending numbers over 0, up to 50", max_attenuations));
}

double ForwardSensorModel::transmission(int level, double chord) const {
  if (level == 0) return 1.0;
  if (kind != ForwardModel::attenuation) return 0.0;
  return std::exp(-attenuations[level - 1] * chord);
}

double list_end(const RangeMeasurements& measurements, const RangeMeasurement& ray, const ForwardSensorModel& model) {
  return ray.beyond_range ? measurements.max_range : measurements.range(ray) + 4.0 * model.sigma;
}

std::vector<VoxelSegment> ray_segments(const VoxelGrid& grid, const RangeMeasurements& measurements,
                                       const RangeMeasurement& ray, const ForwardSensorModel& model) {
  const double end = list_end(measurements, ray, model);
  std::vector<VoxelSegment> segments;
  walk_ray_segments(grid, measurements.origins[ray.origin], measurements.direction(ray), end,
                    [&](int x, int y, int z, double enter, double exit) {
                      segments.push_back({grid.index({x, y, z}), enter, ray.beyond_range ? std::min(exit, end) : exit});
                      return true;
                    });
  return segments;
}

double hit_density(const VoxelGrid& grid, const ForwardSensorModel& model, const Vector3& origin,
                   const VoxelSegment& segment, double z) {
  if (model.voxel_range == VoxelRange::centre)
    return normal_density(z - (grid.centre(segment.voxel) - origin).norm(), model.sigma);
  // A ray that only grazes a voxel has the density of its point.
  const double length = segment.exit - segment.enter;
  if (length < 1e-3 * model.sigma) return normal_density(z - segment.enter, model.sigma);
  return normal_interval((segment.enter - z) / model.sigma, (segment.exit - z) / model.sigma) / length;
}

double first_hit_log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const Vector3& origin,
                                const Vector3& direction, const VoxelSegment* segment, double z, double max_range) {
  // A segment's range is its middle: Eqs. 1 and 2 are not densities to take the mean of.
  const double range = !segment                                  ? max_range
                       : model.voxel_range == VoxelRange::centre ? (grid.centre(segment->voxel) - origin).norm()
                                                                 : 0.5 * (segment->enter + segment->exit);
  if (model.kind == ForwardModel::cone) {
    const double offset = segment ? squared_angular_offset(grid, origin, direction, segment->voxel) /
                                        (model.angular_sigma * model.angular_sigma)
                                  : 0.0;
    return log_cone(z, range, model.sigma, offset);
  }
  // Eq. 1; eta_max and eta_rand do not depend on the map and are left out.
  const double u = (z - range) / model.sigma;
  return -0.5 * model.eta_hit * u * u - std::log(model.sigma * std::sqrt(2.0 * std::numbers::pi));
}

double log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const RangeMeasurements& measurements,
                      const RangeMeasurement& ray, std::span<const std::uint8_t> levels) {
  return log_likelihood(grid, model, measurements, ray, ray_segments(grid, measurements, ray, model), levels);
}

double log_likelihood(const VoxelGrid& grid, const ForwardSensorModel& model, const RangeMeasurements& measurements,
                      const RangeMeasurement& ray, std::span<const VoxelSegment> segments,
                      std::span<const std::uint8_t> levels) {
  const Vector3& origin = measurements.origins[ray.origin];
  const double z = measurements.range(ray);
  if (model.is_first_hit()) {
    const auto first =
        std::find_if(segments.begin(), segments.end(), [&](const VoxelSegment& s) { return levels[s.voxel] > 0; });
    return first_hit_log_likelihood(grid, model, origin, measurements.direction(ray),
                                    first == segments.end() ? nullptr : &*first, z, measurements.max_range);
  }
  double survival = 1.0, density = 0.0;
  for (const VoxelSegment& s : segments) {
    const double passing = model.transmission(levels[s.voxel], (s.exit - s.enter) / grid.resolution);
    if (!ray.beyond_range && passing < 1.0)
      density += survival * (1.0 - passing) * hit_density(grid, model, origin, s, z);
    survival *= passing;
  }
  if (ray.beyond_range) return std::log(model.max_weight * (1.0 - survival) + (1.0 - model.random_weight) * survival);
  return std::log(model.hit_weight() * density + model.random_weight / measurements.max_range);
}

}  // namespace nextview
