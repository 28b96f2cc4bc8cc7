#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"
#include "core/gibbs/range_measurements.hpp"
#include "core/map/voxel_grid.hpp"

/// The Gibbs map once more, straight from its equations, slow and plain. Nothing is shared with the code under test but
/// the structs that say what is asked for: rays have an intersection of their own.
namespace nextview::plain {

using Levels = std::vector<std::uint8_t>;  ///< a map: the level of each voxel

/// A voxel on a ray, and what it does to the ray.
struct Step {
  std::uint32_t voxel = 0;
  double enter = 0.0, exit = 0.0;        ///< distances from the camera [m]
  std::array<double, 3> transmission{};  ///< share of light that passes, per level (beam, attenuation)
  double density = 0.0;                  ///< of the measured range if the ray ends here [1/m] (beam, attenuation)
  double log_first = 0.0;                ///< log p(z | f = this voxel) (paper, cone)
};

/// A measurement and the voxels that it depends on, in order.
struct Ray {
  std::vector<Step> steps;
  bool beyond_range = false;
  double weight = 1.0;
  double log_none = 0.0;  ///< log p(z | f = none) (paper, cone)
};

/// Every voxel that the straight line from `origin` along `direction` meets before `limit` [m], by a slab test of each
/// voxel of the grid, sorted by where it is entered.
std::vector<Step> voxels_on_line(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction, double limit);

/// The posterior of a test problem: everything that has to do with p(z | m) and p(m).
class Posterior {
 public:
  Posterior(const VoxelGrid& grid, const RangeMeasurements& measurements, const ForwardSensorModel& model,
            double prior);

  std::size_t voxel_count() const { return voxel_count_; }
  int levels() const { return model_.levels(); }
  std::span<const Ray> rays() const { return rays_; }

  double log_prior(int level) const { return log_priors_.at(static_cast<std::size_t>(level)); }
  double log_likelihood(const Ray& ray, const Levels& map) const;  ///< log p(z | m) of one ray, its weight not counted
  double log_joint(const Levels& map) const;                       ///< log p(z | m) p(m), the numerator of Eq. 3
  /// Adds how many measured rays reach each voxel of this map, times `share`.
  void add_reach(const Levels& map, double share, std::vector<double>& reach) const;
  /// Log of the full conditional of one voxel, per level, up to a constant (Eqs. 6-8, not only for two levels).
  std::vector<double> log_conditional(const Levels& map, std::uint32_t voxel) const;

 private:
  Ray make_ray(const VoxelGrid& grid, const RangeMeasurements& measurements, const RangeMeasurement& ray) const;

  std::size_t voxel_count_;
  ForwardSensorModel model_;
  double max_range_;
  std::vector<double> log_priors_;  ///< of each level
  std::vector<Ray> rays_;
  std::vector<std::vector<std::size_t>> rays_through_;  ///< each voxel
};

/// What is known of each voxel.
struct Marginals {
  std::vector<double> occupied, upper;  ///< P(level > 0), P(uppermost level)
  std::vector<double> reach;            ///< measured rays that reach it, on average
  double log_evidence = 0.0;            ///< of the enumeration only
};

/// Adds up all maps (Eqs. 3-4).
Marginals enumerate(const Posterior& posterior);

/// The distribution that a voxel's new level is drawn from, given the map: weights, one per level, of any sum, and the
/// same whenever it is asked.
using Conditional = std::function<std::vector<double>(const Levels& map, std::uint32_t voxel)>;

/// The full conditional.
Conditional full_conditional(const Posterior& posterior);
/// Algorithm 1 as printed: 0.7 if the full conditional of being occupied is over 0.5, otherwise 0.4.
Conditional thresholded_conditional(const Posterior& posterior);

/// Draws every voxel in turn, `sweeps` times, from `conditional`; one mean of the maps for each of `batches` runs that
/// follow each other, after a burn-in. Only counting: no conditional probabilities in the mean. `posterior` says what
/// voxels and rays there are.
std::vector<Marginals> gibbs_sampler(const Posterior& posterior, const Conditional& conditional, int sweeps,
                                     int batches, std::uint64_t seed);

}  // namespace nextview::plain
