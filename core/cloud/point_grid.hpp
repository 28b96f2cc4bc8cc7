#pragma once
#include <cstdint>
#include <vector>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// Points in cells about as large as a few of them lie apart, to find the nearest ones of each: where points lie on
/// surfaces, a few cells around it hold them. Points far off from most of the others are not in it.
class PointGrid {
 public:
  /// @param wanted how many nearest ones will be asked for
  PointGrid(const PointCloud& points, std::size_t wanted);

  std::size_t size() const { return points_.size(); }
  /// Which of the cloud's points the i-th here is; they stand cell by cell.
  std::uint32_t number(std::size_t i) const { return numbers_[i]; }
  /// Sets `squared` to the squared distances of the `wanted` points nearest to the i-th, itself included, ascending (of
  /// all if there are fewer), in single precision as nanoflann has them. False if one that is not in the grid might be
  /// among them; then `squared` is anything.
  bool nearest(std::size_t i, std::size_t wanted, std::vector<float>& squared) const;

 private:
  Eigen::Vector3i cell(const Eigen::Vector3f& point) const;
  std::size_t index(int x, int y, int z) const { return (std::size_t(z) * size_.y() + y) * size_.x() + x; }
  void sort_into_cells(const PointCloud& points, const std::vector<std::uint32_t>& inside);
  void gather_within(const Eigen::Vector3f& point, const Eigen::Vector3i& middle, int ring, float limit,
                     std::vector<float>& squared) const;

  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero(), upper_ = Eigen::Vector3f::Zero();
  float edge_ = 1.0f;
  float rounding_ = 0.0f;  ///< of coordinates, at most
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  bool holds_all_ = false;
  std::vector<std::uint32_t> begins_;  ///< of each cell's points, x fastest
  PointCloud points_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace nextview
