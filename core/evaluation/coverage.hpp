#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// Surface coverage (Eq. 17): the share of ground-truth surface samples that have a point of the cloud within d_reg.
/// Two denominators: all of the surface, and some of it, for example what some candidate view can see. One object a
/// d_reg. A value whose copies share the samples.
class SurfaceCoverage {
 public:
  /// `samples` [m, world]; `d_reg` [m].
  /// @throws std::invalid_argument if there are no samples, or if d_reg is not over 0.
  SurfaceCoverage(std::span<const Eigen::Vector3f> samples, double d_reg);

  /// Observes the samples within d_reg of any of these points (distance <= d_reg). The order of calls does not matter.
  /// @throws Stopped; then some are observed.
  void add(const PointCloud& points, const std::stop_token& stop = {});

  /// Those that are observed, as observed() said. @throws std::invalid_argument if there are not as many
  void set_observed(std::vector<std::uint8_t> observed);

  double of_all() const;  ///< share of all samples that are observed
  /// Share of the samples that are not 0 in `counted` that are observed; 0 if there is none.
  /// @pre counted.size() == observed().size()
  double of(std::span<const std::uint8_t> counted) const;
  double d_reg() const { return cells_->d_reg; }
  std::span<const std::uint8_t> observed() const { return observed_; }  ///< one per sample

 private:
  struct Sample {
    Eigen::Vector3f point;
    std::uint32_t index;
  };
  /// A grid of cells around the samples, and those in the order of their cells.
  struct Cells {
    double d_reg;
    Vector3 lower;
    double edge;           ///< of a cell, d_reg at least [m]
    Eigen::Vector3i size;  ///< cells along each axis
    std::vector<Sample> samples;

    Eigen::Vector3i at(const Vector3& point) const;
  };
  static std::shared_ptr<const Cells> make_cells(std::span<const Eigen::Vector3f> samples, double d_reg);

  std::shared_ptr<const Cells> cells_;
  std::vector<std::uint8_t> observed_;
};

}  // namespace nextview
