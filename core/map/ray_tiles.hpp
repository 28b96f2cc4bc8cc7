#pragma once
#include <cstddef>
#include <span>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// The ends [m] of rays from `origin`, those of a tile of directions (0.04 rad wide) one after the other, each tile's
/// in the order they had: rays that go through the same voxels find these in the processor's cache.
PointCloud in_tiles(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends);

/// The ends of rays that leave marks, in the order in which they are walked fastest: in tiles, which take a few
/// nanoseconds a ray, where the marks have no room in the cache.
class OrderedEnds {
 public:
  /// `marks`: what all of them take [bytes]. `ends` must live as long as this.
  OrderedEnds(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, std::size_t marks)
      : tiles_(marks > largest_cached ? in_tiles(origin, ends) : PointCloud()), ends_(tiles_.empty() ? ends : tiles_) {}
  OrderedEnds(const OrderedEnds&) = delete;

  std::size_t size() const { return ends_.size(); }
  std::span<const Eigen::Vector3f> part(std::size_t first, std::size_t count) const {
    return ends_.subspan(first, count);
  }

 private:
  static constexpr std::size_t largest_cached = std::size_t{1} << 24;  // [bytes]
  PointCloud tiles_;
  std::span<const Eigen::Vector3f> ends_;
};

}  // namespace nextview
