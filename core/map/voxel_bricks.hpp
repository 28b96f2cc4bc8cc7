#pragma once
#include <array>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/memory/copy_on_write.hpp"

namespace nextview {

/// The voxels of a grid in bricks of 8 x 8 x 8. A copy costs a pointer: copies share their bricks, and a brick is
/// copied when one of them changes it. Of bricks that hold only unmeasured voxels there is one for all. Copies may live
/// in different threads.
class VoxelBricks {
 public:
  static constexpr int edge = 8;  ///< of a brick [voxels]
  static constexpr std::size_t brick_voxels = std::size_t{edge} * edge * edge;
  using Brick = std::array<Voxel, brick_voxels>;

  /// Unmeasured voxels, `size` of them along each axis.
  explicit VoxelBricks(const Eigen::Vector3i& size = Eigen::Vector3i::Zero());
  /// Of voxels in the grid's order, x fastest. @throws std::invalid_argument if there are not as many.
  VoxelBricks(const Eigen::Vector3i& size, std::span<const Voxel> voxels);

  std::size_t size() const { return std::size_t(size_.x()) * size_.y() * size_.z(); }  ///< voxels
  const Eigen::Vector3i& edges() const { return size_; }                               ///< voxels along each axis
  const Eigen::Vector3i& brick_edges() const { return bricks_; }                       ///< bricks along each axis
  std::size_t brick_count() const { return table_->size(); }

  /// Where a voxel stands when voxels are counted brick by brick, x fastest in both.
  std::size_t place(int x, int y, int z) const {
    const std::size_t brick = (std::size_t(z >> 3) * bricks_.y() + (y >> 3)) * bricks_.x() + (x >> 3);
    return brick * brick_voxels + ((z & 7) << 6 | (y & 7) << 3 | (x & 7));
  }
  /// The position of the voxel in the grid. Places beyond the grid's edges, of bricks that stick out, have one too.
  Eigen::Vector3i cell(std::size_t place) const;

  const Voxel& at_place(std::size_t place) const { return (*(*table_)[place / brick_voxels])[place % brick_voxels]; }
  const Voxel& at(int x, int y, int z) const { return at_place(place(x, y, z)); }
  /// By the grid's number. Slower than walking.
  const Voxel& operator[](std::size_t voxel) const;

  /// The voxel at a place, to be changed.
  Voxel& change(std::size_t place) { return table_.change()[place / brick_voxels].change()[place % brick_voxels]; }
  /// The bricks, to be changed: different ones from different threads.
  std::span<CopyOnWrite<Brick>> change_bricks() { return table_.change(); }
  std::span<const CopyOnWrite<Brick>> bricks() const { return *table_; }

  /// Walks the voxels in the grid's order.
  class Iterator {
   public:
    using value_type = Voxel;
    using difference_type = std::ptrdiff_t;
    using pointer = const Voxel*;
    using reference = const Voxel&;
    using iterator_category = std::forward_iterator_tag;
    Iterator() = default;
    Iterator(const VoxelBricks& bricks, std::size_t voxel);
    const Voxel& operator*() const { return *voxel_; }
    const Voxel* operator->() const { return voxel_; }
    Iterator& operator++() {
      ++number_, ++voxel_;
      if ((++x_ & (edge - 1)) == 0 || x_ == bricks_->size_.x()) next_row();
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return number_ == other.number_; }

   private:
    void next_row();
    const VoxelBricks* bricks_ = nullptr;
    const Voxel* voxel_ = nullptr;
    std::size_t number_ = 0;
    int x_ = 0, y_ = 0, z_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }
  /// From a voxel on, by the grid's number.
  Iterator from(std::size_t voxel) const { return {*this, voxel}; }
  /// All of them, in the grid's order.
  std::vector<Voxel> dense() const { return {begin(), end()}; }

  /// What the bricks take that hold anything [bytes].
  std::size_t bytes() const;
  /// What of it `other`, of the same size, does not share [bytes].
  std::size_t bytes_beside(const VoxelBricks& other) const;

 private:
  Eigen::Vector3i size_, bricks_;
  CopyOnWrite<Brick> empty_;
  CopyOnWrite<std::vector<CopyOnWrite<Brick>>> table_;
};

}  // namespace nextview
