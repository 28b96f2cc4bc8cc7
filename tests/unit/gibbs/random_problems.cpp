#include "tests/unit/gibbs/random_problems.hpp"

#include <random>

#include "tests/unit/gibbs/plain_model.hpp"

namespace nextview::random_problems {
namespace {

constexpr double resolution = 0.1;

class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : random_(seed) {}
  double operator()(double lowest, double highest) {
    return lowest + (highest - lowest) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  Vector3 in_box(const Vector3& lower, const Vector3& upper) {
    Vector3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = (*this)(lower[axis], upper[axis]);
    return point;
  }

 private:
  std::mt19937_64 random_;
};

/// Before the corridor's first voxel, or anywhere around the other grids.
Vector3 random_origin(const VoxelGrid& grid, Uniform& uniform) {
  if (grid.size.y() == 1 && grid.size.z() == 1)
    return {grid.lower().x() - 0.6 * resolution, grid.lower().y() + uniform(0.3, 0.7) * resolution,
            grid.lower().z() + uniform(0.3, 0.7) * resolution};
  const double radius = (grid.upper() - grid.lower()).norm() / 2.0 + resolution;
  Vector3 direction = uniform.in_box(Vector3::Constant(-1.0), Vector3::Constant(1.0));
  if (grid.size.z() == 1) direction.z() *= 0.05;  // slanted, but within the layer for long
  return (grid.lower() + grid.upper()) / 2.0 + radius * direction.normalized();
}

/// A point that a ray is aimed at; the far end of a corridor.
Vector3 random_target(const VoxelGrid& grid, Uniform& uniform) {
  Vector3 lower = grid.lower();
  if (grid.size.y() == 1 && grid.size.z() == 1) lower.x() = grid.upper().x() - resolution;
  return uniform.in_box(lower, grid.upper());
}

/// Three standard uniform numbers make a bump of the right spread; the models need not be right.
double noise(Uniform& uniform) { return 2.0 * (uniform(-0.5, 0.5) + uniform(-0.5, 0.5) + uniform(-0.5, 0.5)); }

}  // namespace

Problem make(const Shape& shape, std::uint64_t seed) {
  Uniform uniform(seed);
  Problem problem{{resolution, {-3, 2, 1}, shape.size}, {}, shape.sigma * resolution};
  const VoxelGrid& grid = problem.grid;
  plain::Levels truth(grid.voxel_count());
  for (std::uint8_t& level : truth) level = uniform(0.0, 1.0) < 0.25;
  for (int i = 0; i < shape.origins; ++i) problem.measurements.origins.push_back(random_origin(grid, uniform));
  const double max_range = problem.measurements.max_range = (grid.upper() - grid.lower()).norm() + 3.0 * resolution;
  for (int i = 0; i < shape.rays; ++i) {
    RangeMeasurement ray;
    ray.origin = static_cast<std::uint32_t>(i % shape.origins);
    const Vector3& origin = problem.measurements.origins[ray.origin];
    const Vector3 direction = (random_target(grid, uniform) - origin).normalized();
    double range = 2.0 * max_range;
    for (const plain::Step& step : plain::voxels_on_line(grid, origin, direction, max_range)) {
      if (truth[step.voxel] == 0) continue;
      range = uniform(step.enter, step.exit) + problem.sigma * noise(uniform);
      break;
    }
    if (uniform(0.0, 1.0) < 0.15) range = uniform(0.5 * resolution, max_range);  // an outlier
    ray.beyond_range = range > max_range;
    ray.end = (origin + (ray.beyond_range ? max_range : std::max(range, 0.1 * resolution)) * direction).cast<float>();
    if (shape.weights) ray.weight = static_cast<std::uint16_t>(uniform(1.0, 4.0));
    problem.measurements.rays.push_back(ray);
  }
  return problem;
}

Problem room() { return make({"room", {10, 8, 5}, 4, 600, 0.4}, 7); }

ForwardSensorModel model_for(const Problem& problem, ForwardModel kind, VoxelRange range, double independence) {
  ForwardSensorModel model;
  model.kind = kind;
  model.voxel_range = range;
  model.sigma = problem.sigma;
  model.angular_sigma = 0.3;
  model.random_weight = 0.1;
  model.attenuations = {0.3, 2.0};
  model.independence = independence;
  return model;
}

std::vector<Shape> small() {
  return {{"corridor of one ray", {6, 1, 1}, 1, 1, 0.5},
          {"corridor", {10, 1, 1}, 1, 6, 1.0},
          {"corridor of noisy rays", {12, 1, 1}, 1, 12, 1.5},
          {"corridor of weighted rays", {9, 1, 1}, 1, 3, 1.0, true},
          {"square", {3, 3, 1}, 2, 6, 0.8},
          {"oblong", {4, 3, 1}, 3, 10, 1.2},
          {"oblong of weighted rays", {3, 4, 1}, 2, 5, 0.8, true},
          {"cube", {2, 2, 2}, 3, 9, 0.6},
          {"brick", {3, 2, 2}, 2, 10, 1.0}};
}

std::vector<Shape> large() {
  return {{"long corridor", {18, 1, 1}, 1, 5, 1.0},
          {"large oblong", {5, 4, 1}, 2, 8, 1.0},
          {"large brick", {3, 3, 2}, 3, 12, 1.2}};
}

}  // namespace nextview::random_problems
