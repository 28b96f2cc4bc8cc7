#pragma once
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// Surface coverage (Eq. 17): the share of ground-truth surface samples that have a point of the cloud within d_reg.
/// Two denominators: all of the surface, and the surface that some candidate view can see. One object a d_reg.
class SurfaceCoverage {
 public:
  /// `samples` [m, world]; `visible[i]`: some candidate view can see sample i; `d_reg` [m].
  /// @throws std::invalid_argument if there are no samples, if `visible` is not as long, or if d_reg is not over 0.
  SurfaceCoverage(std::span<const Eigen::Vector3f> samples, std::span<const std::uint8_t> visible, double d_reg);

  /// Observes the samples within d_reg of any of these points (distance <= d_reg). The order of calls does not matter.
  /// @throws Stopped; then some are observed, and go_back helps.
  void add(const PointCloud& points, const std::stop_token& stop = {});
  /// To what observed() was.
  void go_back(std::span<const std::uint8_t> observed);

  double of_all() const;      ///< share of all samples that are observed
  double of_visible() const;  ///< share of the visible samples that are observed; 0 if none is visible
  double d_reg() const { return d_reg_; }
  std::span<const std::uint8_t> observed() const { return observed_; }  ///< one a sample

 private:
  struct Sample {
    Eigen::Vector3f point;
    std::uint32_t index;
  };
  Eigen::Vector3i cell_at(const Vector3& point) const;
  std::size_t cell_index(const Eigen::Vector3i& cell) const {
    return (std::size_t(cell.z()) * size_.y() + cell.y()) * size_.x() + cell.x();
  }
  void observe_around(const Eigen::Vector3f& point);

  double d_reg_;
  std::vector<std::uint8_t> visible_, observed_;
  // The samples sorted into a grid of cells, cell by cell.
  Vector3 lower_;
  double edge_;           ///< of a cell [m]
  Eigen::Vector3i size_;  ///< cells along each axis
  std::vector<Sample> samples_;
  std::vector<std::uint32_t> cell_begin_;  ///< of each cell its first sample, and the end
};

}  // namespace nextview
