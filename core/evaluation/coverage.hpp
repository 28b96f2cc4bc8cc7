#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// Surface coverage (Eq. 17): the share of ground-truth surface samples that have a point of the cloud within d_reg.
/// Two denominators: all of the surface, and the surface that some candidate view can see. One object a d_reg. A value
/// whose copies share the samples.
class SurfaceCoverage {
 public:
  /// `samples` [m, world]; `visible[i]`: some candidate view can see sample i; `d_reg` [m].
  /// @throws std::invalid_argument if there are no samples, if `visible` is not as long, or if d_reg is not over 0.
  SurfaceCoverage(std::span<const Eigen::Vector3f> samples, std::span<const std::uint8_t> visible, double d_reg);

  /// Observes the samples within d_reg of any of these points (distance <= d_reg). The order of calls does not matter.
  /// @throws Stopped; then some are observed.
  void add(const PointCloud& points, const std::stop_token& stop = {});

  /// Those that are observed, as observed() said. @throws std::invalid_argument if there are not as many
  void set_observed(std::vector<std::uint8_t> observed);

  double of_all() const;      ///< share of all samples that are observed
  double of_visible() const;  ///< share of the visible samples that are observed; 0 if none is visible
  /// Share of the samples that are not 0 in `counted` that are observed; 0 if there is none.
  double of(std::span<const std::uint8_t> counted) const;
  double d_reg() const { return cells_->d_reg; }
  std::span<const std::uint8_t> observed() const { return observed_; }  ///< one per sample

 private:
  struct Sample {
    Eigen::Vector3f point;
    std::uint32_t index;
  };
  /// The samples sorted into a grid of cells, cell by cell.
  struct Cells {
    double d_reg;
    std::vector<std::uint8_t> visible;
    Vector3 lower;
    double edge;           ///< of a cell [m]
    Eigen::Vector3i size;  ///< cells along each axis
    std::vector<Sample> samples;
    std::vector<std::uint32_t> begin;  ///< of each cell its first sample, and the end

    Eigen::Vector3i at(const Vector3& point) const;
    std::size_t index(const Eigen::Vector3i& cell) const {
      return (std::size_t(cell.z()) * size.y() + cell.y()) * size.x() + cell.x();
    }
  };
  static std::shared_ptr<const Cells> make_cells(std::span<const Eigen::Vector3f> samples,
                                                 std::span<const std::uint8_t> visible, double d_reg);
  void observe_around(const Eigen::Vector3f& point);

  std::shared_ptr<const Cells> cells_;
  std::vector<std::uint8_t> observed_;
};

}  // namespace nextview
