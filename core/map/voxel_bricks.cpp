#include "core/map/voxel_bricks.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

namespace nextview {
namespace {

/// `part` of each voxel, in the grid's order; several layers at once.
template <class Part, class PartOf>
std::vector<Part> of_each(const VoxelBricks& voxels, PartOf part_of) {
  std::vector<Part> parts(voxels.size());
  const std::size_t layer = std::size_t(voxels.edges().x()) * voxels.edges().y();
  tbb::parallel_for(0, voxels.edges().z(), [&](int z) {
    auto voxel = voxels.from(z * layer);
    for (std::size_t i = z * layer; i < (z + 1) * layer; ++i, ++voxel) parts[i] = std::invoke(part_of, *voxel);
  });
  return parts;
}

/// Sorted.
std::vector<const VoxelBricks::Brick*> each_once(std::vector<const VoxelBricks::Brick*> bricks) {
  std::ranges::sort(bricks, std::less<>());
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  return bricks;
}

std::size_t bytes_of(const std::vector<const VoxelBricks::Brick*>& bricks) {
  std::size_t bytes = 0;
  for (const VoxelBricks::Brick* brick : bricks) bytes += brick->bytes();
  return bytes;
}

}  // namespace

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size)
    : size_(size),
      bricks_((size.array() + (edge - 1)) / edge),
      table_(std::in_place, std::size_t(bricks_.x()) * bricks_.y() * bricks_.z(), empty_) {}

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size, std::span<const Voxel> voxels) : VoxelBricks(size) {
  if (voxels.size() != this->size())
    throw std::invalid_argument(fmt::format("voxel bricks: {} voxels for a grid of {}", voxels.size(), this->size()));
  set_each([&](std::size_t v) { return voxels[v]; });
}

VoxelBricks VoxelBricks::made_of(const Eigen::Vector3i& size, const std::function<Voxel(std::size_t)>& voxel_of) {
  VoxelBricks made(size);
  made.set_each(voxel_of);
  return made;
}

void VoxelBricks::set_each(const std::function<Voxel(std::size_t)>& voxel_of) {
  const auto table = change_bricks();
  tbb::parallel_for(std::size_t{0}, brick_count(), [&](std::size_t b) {
    Brick& brick = table[b].change();
    for_each_row(b, [&](std::size_t first, const Eigen::Vector3i& cell, std::size_t count) {
      const std::size_t v = (std::size_t(cell.z()) * size_.y() + cell.y()) * size_.x() + cell.x();
      for (std::size_t i = 0; i < count; ++i) brick.set(first + i, voxel_of(v + i));
    });
  });
}

std::size_t VoxelBricks::Brick::measured_count() const {
  std::size_t count = 0;
  for (const std::uint8_t state : states_) count += state / is_measured;
  return count;
}

bool VoxelBricks::Brick::is_uniform() const {
  // Each is as the one after it, to the bit.
  if (!told_.empty() || std::memcmp(&states_[0], &states_[1], brick_voxels - 1) != 0) return false;
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return std::memcmp(&numbers_[0], &numbers_[1], (brick_voxels - 1) * sizeof(float)) == 0;
}

bool VoxelBricks::Brick::holds_nothing() const {
  return std::ranges::all_of(numbers_, [](float number) { return number == 0.0f; }) &&
         std::ranges::all_of(states_, [](std::uint8_t state) { return state == 0; });
}

void VoxelBricks::Brick::set(const std::array<float, brick_voxels>& numbers,
                             const std::array<std::uint8_t, brick_voxels>& states) {
  constexpr float farthest = std::numeric_limits<std::uint16_t>::max();
  for (std::size_t i = 0; i < brick_voxels; ++i) {
    const bool is_distance = !(states[i] & is_measured);
    if ((states[i] & class_bits) > static_cast<std::uint8_t>(VoxelClass::occupied) ||
        states[i] > (class_bits | is_measured) || !std::isfinite(numbers[i]) ||
        (is_distance && (numbers[i] < 0.0f || numbers[i] > farthest)))
      throw std::invalid_argument("no voxels are kept as these");
  }
  numbers_ = numbers;
  states_ = states;
}

void VoxelBricks::Brick::set(std::size_t i, const Voxel& voxel) {
  if (told_.empty()) told_.resize(brick_voxels);
  numbers_[i] = voxel.measured ? voxel.log_odds : float(voxel.occlusion_distance);
  states_[i] = static_cast<std::uint8_t>((voxel.measured ? is_measured : 0) | static_cast<int>(voxel.voxel_class));
  told_[i] = {voxel.probability, voxel.entropy};
}

Eigen::Vector3i VoxelBricks::cell(std::size_t place) const {
  const int brick = static_cast<int>(place / brick_voxels), inside = static_cast<int>(place % brick_voxels);
  const int nx = bricks_.x(), ny = bricks_.y();
  return {brick % nx * edge + (inside & 7), brick / nx % ny * edge + (inside >> 3 & 7),
          brick / (nx * ny) * edge + (inside >> 6)};
}

Voxel VoxelBricks::operator[](std::size_t voxel) const { return *from(voxel); }

std::vector<Voxel> VoxelBricks::dense() const { return of_each<Voxel>(*this, std::identity()); }

std::vector<float> probabilities(const VoxelBricks& voxels) { return of_each<float>(voxels, &Voxel::probability); }

VoxelBricks::Iterator::Iterator(const VoxelBricks& bricks, std::size_t voxel) : bricks_(&bricks), number_(voxel) {
  if (voxel >= bricks.size()) return;
  const std::size_t nx = bricks.size_.x(), ny = bricks.size_.y();
  x_ = static_cast<int>(voxel % nx);
  y_ = static_cast<int>(voxel / nx % ny);
  z_ = static_cast<int>(voxel / (nx * ny));
  find();
}

/// Into the next brick, or the next row.
void VoxelBricks::Iterator::jump() {
  if (x_ == bricks_->size_.x()) {
    x_ = 0;
    if (++y_ == bricks_->size_.y()) y_ = 0, ++z_;
  }
  if (number_ < bricks_->size()) find();
}

void VoxelBricks::Iterator::find() {
  const std::size_t place = bricks_->place(x_, y_, z_);
  brick_ = &*bricks_->bricks()[place / brick_voxels];
  in_brick_ = place % brick_voxels;
}

std::size_t VoxelBricks::bytes() const {
  std::vector<const Brick*> own;
  for (const auto& brick : *table_)
    if (!brick.shares_with(empty_)) own.push_back(&*brick);
  return bytes_of(each_once(own));
}

std::size_t VoxelBricks::bytes_beside(const VoxelBricks& other) const {
  if (table_.shares_with(other.table_)) return 0;
  const auto &bricks = *table_, &others = *other.table_;
  std::vector<const Brick*> own;
  for (std::size_t b = 0; b < bricks.size(); ++b)
    if (!bricks[b].shares_with(others[b])) own.push_back(&*bricks[b]);
  own = each_once(own);
  // Of those that several places share, one may be the other's at another place.
  std::vector<bool> shared(own.size());
  for (const auto& brick : others) {
    const auto found = std::lower_bound(own.begin(), own.end(), &*brick, std::less<>());
    if (found != own.end() && *found == &*brick) shared[std::size_t(found - own.begin())] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!shared[i]) own[kept++] = own[i];
  own.resize(kept);
  return bricks.size() * sizeof(CopyOnWrite<Brick>) + bytes_of(own);
}

}  // namespace nextview
