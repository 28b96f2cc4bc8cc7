#include "tests/unit/gibbs/plain_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nextview::plain {
namespace {

double gaussian(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}
double gaussian_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// The range density of a ray that ends in a voxel.
double range_density(const ForwardSensorModel& model, const Step& step, double centre_range, double z) {
  if (model.voxel_range == VoxelRange::centre) return gaussian(z - centre_range, model.sigma);
  return (gaussian_cdf((step.exit - z) / model.sigma) - gaussian_cdf((step.enter - z) / model.sigma)) /
         (step.exit - step.enter);
}

/// Eqs. 1 and 2. `offset`: angle between the ray and the direction to the voxel's centre [rad].
double log_first_hit(const ForwardSensorModel& model, double z, double z_expected, double offset) {
  const double dz = (z - z_expected) / model.sigma;
  if (model.kind == ForwardModel::paper)
    return -std::log(model.sigma * std::sqrt(2.0 * std::numbers::pi)) - model.eta_hit * dz * dz / 2.0;
  const double angular = offset * offset / (model.angular_sigma * model.angular_sigma);
  const double behind = 0.5 / (1.0 + std::exp(-(2.0 * (dz + 2.0) + angular)));
  return std::log(behind + std::exp(-(dz * dz + angular)) / 3.0);
}

/// Share of light that passes a chord in a voxel of this level.
double transmission(const ForwardSensorModel& model, int level, double chord, double resolution) {
  if (level == 0) return 1.0;
  if (model.kind != ForwardModel::attenuation) return 0.0;
  return std::exp(-model.attenuations.at(level - 1) * chord / resolution);
}

}  // namespace

std::vector<Step> voxels_on_line(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction, double limit) {
  std::vector<Step> steps;
  for (std::uint32_t voxel = 0; voxel < grid.voxel_count(); ++voxel) {
    const Vector3 lower = (grid.first + grid.cell(voxel)).cast<double>() * grid.resolution;
    double enter = 0.0, exit = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double low = lower[axis] - origin[axis], high = low + grid.resolution, d = direction[axis];
      if (d == 0.0) {
        if (low > 0.0 || high <= 0.0) exit = -1.0;  // runs beside this slab
        continue;
      }
      enter = std::max(enter, std::min(low / d, high / d));
      exit = std::min(exit, std::max(low / d, high / d));
    }
    if (enter >= exit || enter >= limit) continue;
    Step& step = steps.emplace_back();
    step.voxel = voxel, step.enter = enter, step.exit = exit;
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.enter < b.enter; });
  return steps;
}

Posterior::Posterior(const VoxelGrid& grid, const RangeMeasurements& measurements, const ForwardSensorModel& model,
                     double prior)
    : voxel_count_(grid.voxel_count()), model_(model), max_range_(measurements.max_range) {
  for (int level = 0; level < levels(); ++level)
    log_priors_.push_back(std::log(level == 0 ? 1.0 - prior : prior / (levels() - 1)));
  for (const RangeMeasurement& ray : measurements.rays) rays_.push_back(make_ray(grid, measurements, ray));
  rays_through_.resize(voxel_count_);
  for (std::size_t r = 0; r < rays_.size(); ++r)
    for (const Step& step : rays_[r].steps) rays_through_[step.voxel].push_back(r);
}

Ray Posterior::make_ray(const VoxelGrid& grid, const RangeMeasurements& measurements,
                        const RangeMeasurement& measured) const {
  const Vector3 origin = measurements.origins.at(measured.origin);
  const Vector3 along = measured.end.cast<double>() - origin, direction = along / along.norm();
  const double z = measured.beyond_range ? max_range_ : along.norm();
  Ray ray;
  ray.beyond_range = measured.beyond_range;
  ray.weight = measured.weight;
  ray.steps = voxels_on_line(grid, origin, direction, measured.beyond_range ? max_range_ : z + 4.0 * model_.sigma);
  const bool first_hit = model_.kind == ForwardModel::paper || model_.kind == ForwardModel::cone;
  if (first_hit) ray.log_none = log_first_hit(model_, z, max_range_, 0.0);
  for (Step& step : ray.steps) {
    if (measured.beyond_range) step.exit = std::min(step.exit, max_range_);  // nothing is known of what comes after
    const Vector3 to_centre = grid.centre(step.voxel) - origin;
    const double offset = std::atan2(to_centre.cross(direction).norm(), to_centre.dot(direction));
    const double middle = (step.enter + step.exit) / 2.0;
    const double range = model_.voxel_range == VoxelRange::centre ? to_centre.norm() : middle;
    if (first_hit) step.log_first = log_first_hit(model_, z, range, offset);
    step.density = range_density(model_, step, to_centre.norm(), z);
    for (int level = 0; level < levels(); ++level)
      step.transmission.at(level) = transmission(model_, level, step.exit - step.enter, grid.resolution);
  }
  return ray;
}

double Posterior::log_likelihood(const Ray& ray, const Levels& map) const {
  if (model_.kind == ForwardModel::paper || model_.kind == ForwardModel::cone) {
    for (const Step& step : ray.steps)
      if (map[step.voxel] > 0) return step.log_first;
    return ray.log_none;
  }
  double survival = 1.0, density = 0.0;
  for (const Step& step : ray.steps) {
    const double misses = step.transmission[map[step.voxel]];
    density += survival * (1.0 - misses) * step.density;
    survival *= misses;
  }
  const double w_hit = 1.0 - model_.random_weight - model_.max_weight;
  return std::log(ray.beyond_range ? model_.max_weight * (1.0 - survival) + (1.0 - model_.random_weight) * survival
                                   : w_hit * density + model_.random_weight / max_range_);
}

double Posterior::log_joint(const Levels& map) const {
  double sum = 0.0;
  for (const std::uint8_t level : map) sum += log_prior(level);
  for (const Ray& ray : rays_) sum += ray.weight * model_.independence * log_likelihood(ray, map);
  return sum;
}

void Posterior::add_reach(const Levels& map, double share, std::vector<double>& reach) const {
  for (const Ray& ray : rays_) {
    double survival = ray.weight * share;
    for (const Step& step : ray.steps) {
      reach[step.voxel] += survival;
      survival *= step.transmission[map[step.voxel]];
    }
  }
}

std::vector<double> Posterior::log_conditional(const Levels& map, std::uint32_t voxel) const {
  std::vector<double> result;
  Levels changed = map;
  for (int level = 0; level < levels(); ++level) {
    changed[voxel] = static_cast<std::uint8_t>(level);
    double sum = log_prior(level);
    for (const std::size_t r : rays_through_[voxel])
      sum += rays_[r].weight * model_.independence * log_likelihood(rays_[r], changed);
    result.push_back(sum);
  }
  return result;
}

}  // namespace nextview::plain
