#include "core/map/voxel_bricks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nextview {

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size)
    : size_(size),
      bricks_((size.array() + (edge - 1)) / edge),
      table_(std::in_place, std::size_t(bricks_.x()) * bricks_.y() * bricks_.z(), empty_) {}

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size, std::span<const Voxel> voxels) : VoxelBricks(size) {
  if (voxels.size() != this->size())
    throw std::invalid_argument(fmt::format("voxel bricks: {} voxels for a grid of {}", voxels.size(), this->size()));
  const auto table = change_bricks();
  std::size_t v = 0;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); x += edge) {
        const std::size_t first = place(x, y, z);
        const std::size_t count = std::min<std::size_t>(edge, size.x() - x);
        std::copy_n(&voxels[v], count, table[first / brick_voxels].change().begin() + first % brick_voxels);
        v += count;
      }
}

Eigen::Vector3i VoxelBricks::cell(std::size_t place) const {
  const int brick = static_cast<int>(place / brick_voxels), inside = static_cast<int>(place % brick_voxels);
  const int nx = bricks_.x(), ny = bricks_.y();
  return {brick % nx * edge + (inside & 7), brick / nx % ny * edge + (inside >> 3 & 7),
          brick / (nx * ny) * edge + (inside >> 6)};
}

const Voxel& VoxelBricks::operator[](std::size_t voxel) const {
  const std::size_t nx = size_.x(), ny = size_.y();
  return at(static_cast<int>(voxel % nx), static_cast<int>(voxel / nx % ny), static_cast<int>(voxel / (nx * ny)));
}

VoxelBricks::Iterator::Iterator(const VoxelBricks& bricks, std::size_t voxel) : bricks_(&bricks), number_(voxel) {
  if (voxel >= bricks.size()) return;
  const std::size_t nx = bricks.size_.x(), ny = bricks.size_.y();
  x_ = static_cast<int>(voxel % nx);
  y_ = static_cast<int>(voxel / nx % ny);
  z_ = static_cast<int>(voxel / (nx * ny));
  voxel_ = &bricks.at(x_, y_, z_);
}

void VoxelBricks::Iterator::next_row() {
  if (x_ == bricks_->size_.x()) {
    x_ = 0;
    if (++y_ == bricks_->size_.y()) y_ = 0, ++z_;
  }
  if (number_ < bricks_->size()) voxel_ = &bricks_->at(x_, y_, z_);
}

std::size_t VoxelBricks::bytes() const {
  return sizeof(Brick) * std::ranges::count_if(*table_, [&](const auto& brick) { return !brick.shares_with(empty_); });
}

std::size_t VoxelBricks::bytes_beside(const VoxelBricks& other) const {
  if (table_.shares_with(other.table_)) return 0;
  std::size_t own = 0;
  for (std::size_t b = 0; b < table_->size(); ++b) own += !(*table_)[b].shares_with((*other.table_)[b]);
  return own * sizeof(Brick) + table_->size() * sizeof(CopyOnWrite<Brick>);
}

}  // namespace nextview
