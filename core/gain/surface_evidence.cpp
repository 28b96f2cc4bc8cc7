#include "core/gain/surface_evidence.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "core/map/brick_kinds.hpp"
#include "core/map/distance_transform.hpp"

namespace nextview {
namespace {

/// How far around the object's box voxels are looked at, as a share of its size: farther off, next to nothing is found.
constexpr double margin = 0.12;

using Kind = SurfaceEvidence::Kind;

/// Of its probability: other maps than the conventional one have no log-odds. A map has few different ones, and
/// logarithms are expensive: each thread remembers those that it met last.
float log_odds_of(float probability) {
  struct Known {
    float probability = 0.5f, log_odds = 0.0f;
  };
  constexpr int places = 8;  // as a power of 2
  constinit thread_local std::array<Known, 1 << places> remembered{};
  Known& known = remembered[std::bit_cast<std::uint32_t>(probability) * 2654435769u >> (32 - places)];
  if (known.probability != probability)
    known = {probability, static_cast<float>(log_odds(std::clamp(double(probability), 1e-3, 1 - 1e-3)))};
  return known.log_odds;
}

}  // namespace

SurfaceEvidence::SurfaceEvidence(const VoxelGrid& grid, const VoxelBricks& voxels, const VoxelBricks& occlusions,
                                 double occupancy_threshold, const OpenBorder& border, double finest)
    : grid_{grid.resolution, grid.first, Eigen::Vector3i::Zero()}, voxels_(voxels), occlusions_(occlusions) {
  const std::optional<OccupiedHull> hull = occupied_hull(voxels, occupancy_threshold);
  if (!hull) return;
  hull_ = *hull;
  set_region(grid);
  while (2 * block_edge_ <= finest * size_) block_edge_ *= 2;
  read_kinds(occupancy_threshold);
  occupy(border.within);
  measure_distances();
  measure_border(border);
}

void SurfaceEvidence::set_region(const VoxelGrid& whole) {
  const Eigen::Vector3i lowest(hull_.lowest[0], hull_.lowest[1], hull_.lowest[2]);
  const Eigen::Vector3i highest(hull_.highest[0], hull_.highest[1], hull_.highest[2]);
  const Eigen::Vector3i edges = highest - lowest + Eigen::Vector3i::Ones();
  size_ = edges.cast<double>().norm();
  object_ = {(whole.first + lowest).cast<double>() * whole.resolution,
             (whole.first + highest + Eigen::Vector3i::Ones()).cast<double>() * whole.resolution};
  const Eigen::Vector3i around = Eigen::Vector3i::Constant(static_cast<int>(std::ceil(margin * size_)) + 1);
  offset_ = (lowest - around).cwiseMax(0);
  grid_.first = whole.first + offset_;
  grid_.size = (highest + around + Eigen::Vector3i::Ones()).cwiseMin(whole.size) - offset_;
}

void SurfaceEvidence::read_kinds(double threshold) {
  occupied_ = unmeasured_ = BitRows(grid_.size);
  constexpr int edge = BrickKinds::edge;
  const Eigen::Vector3i first = offset_ / edge, last = (offset_ + grid_.size - Eigen::Vector3i::Ones()) / edge;
  // A layer of bricks each: what is written for one lies in rows of its own.
  tbb::parallel_for(first.z(), last.z() + 1, [&](int brick_z) {
    BrickKinds kinds(threshold);
    for (int brick_y = first.y(); brick_y <= last.y(); ++brick_y)
      for (int brick_x = first.x(); brick_x <= last.x(); ++brick_x) {
        const Eigen::Vector3i lowest = edge * Eigen::Vector3i(brick_x, brick_y, brick_z);
        const std::size_t place = voxels_.place(lowest.x(), lowest.y(), lowest.z());
        kinds.read(*voxels_.bricks()[place / VoxelBricks::brick_voxels]);
        for (int row = 0; row < edge * edge; ++row) {
          const Eigen::Vector3i cell = lowest + BrickKinds::cell(row) - offset_;
          if (!grid_.contains({0, cell.y(), cell.z()})) continue;
          occupied_.set_eight(cell, kinds.occupied[std::size_t(row)]);
          unmeasured_.set_eight(cell, kinds.unmeasured[std::size_t(row)]);
        }
      }
  });
}

void SurfaceEvidence::occupy(std::span<const Eigen::Vector3f> scanned) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scanned.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3i cell = grid_.cell_at(scanned[i].cast<double>());
      if (grid_.contains(cell) && !unmeasured_.at(cell)) occupied_.set(cell);
    }
  });
}

void SurfaceEvidence::measure_distances() {
  const BitRows either = BitRows::either(occupied_, unmeasured_);
  const auto blocks = [&](BitRows voxels) {
    for (int edge = 1; edge < block_edge_; edge *= 2) voxels = voxels.halved();
    return voxels;
  };
  unmeasured_blocks_ = blocks(unmeasured_);
  blocks_before_ = unmeasured_blocks_.counts_before();
  free_blocks_ = blocks(either).complement();
  tbb::parallel_invoke([&] { to_occupied_ = squared_distances(unmeasured_blocks_, blocks(occupied_)); },
                       [&] { to_free_ = squared_distances(unmeasured_blocks_, blocks(either.complement())); },
                       [&] {
                         may_hold_surface_ = either;
                         may_hold_surface_.grow({});
                         beside_free_blocks_ = free_blocks_;
                         beside_free_blocks_.grow({});
                       });
  // Nothing is farther off than the object is large, or its margin is wide.
  log_shares_.resize(static_cast<std::size_t>(size_ * size_) + 2);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, log_shares_.size(), 1024), [&](const auto& range) {
    for (std::size_t squared = range.begin(); squared != range.end(); ++squared)
      log_shares_[squared] =
          static_cast<float>(0.5 * std::log(std::max<double>(1.0, double(squared))) - std::log(size_));
  });
}

void SurfaceEvidence::measure_border(const OpenBorder& border) {
  blocks_ = {1.0, Eigen::Vector3i::Zero(), (grid_.size.array() + block_edge_ - 1) / block_edge_};
  going_on_.assign(blocks_.voxel_count(), 0.0f);
  const auto length = static_cast<float>(border.spacing / (block_edge_ * grid_.resolution));
  for (const Eigen::Vector3f& point : border.beyond) {
    const Eigen::Vector3i cell = grid_.cell_at(point.cast<double>());
    if (!grid_.contains(cell)) continue;
    for (int n = 0; n < 27; ++n) {
      const Eigen::Vector3i block = block_of(cell) + Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      if (blocks_.contains(block)) going_on_[blocks_.index(block)] += length;
    }
  }
}

float SurfaceEvidence::log_share(std::size_t squared_distance) const {
  return log_shares_[std::min(squared_distance, log_shares_.size() - 1)];
}

float SurfaceEvidence::log_share_of_blocks(std::int32_t squared_distance) const {
  // What lies in the same block is half an edge away.
  const auto squared_edge = std::size_t(block_edge_) * std::size_t(block_edge_);
  return log_share(std::max(std::size_t(squared_distance) * squared_edge, squared_edge / 4));
}

Eigen::Vector3i SurfaceEvidence::first_unmeasured(const Eigen::Vector3i& block) const {
  Eigen::Vector3i lowest = block_edge_ * block;
  const Eigen::Vector3i beyond = (lowest.array() + block_edge_).cwiseMin(grid_.size.array());
  for (int z = lowest.z(); z < beyond.z(); ++z)
    for (int y = lowest.y(); y < beyond.y(); ++y)
      for (int x = lowest.x(); x < beyond.x(); ++x)
        if (unmeasured_.at({x, y, z})) return {x, y, z};
  return lowest;
}

SurfaceEvidence::Unmeasured SurfaceEvidence::unmeasured(const Eigen::Vector3i& block) const {
  const std::size_t number = unmeasured_blocks_.rank(block, blocks_before_);
  const Eigen::Vector3i in_whole = first_unmeasured(block) + offset_;
  const std::size_t place = occlusions_.place(in_whole.x(), in_whole.y(), in_whole.z());
  const VoxelBricks::Brick& brick = *occlusions_.bricks()[place / VoxelBricks::brick_voxels];
  const float to_free = log_share_of_blocks(to_free_[number]);
  const std::int32_t behind =
      std::min<std::int32_t>(brick.occlusion_distance(place % VoxelBricks::brick_voxels), 10000);
  const auto outside = static_cast<float>(hull_.outside(in_whole) / size_);
  return {1.0f,
          log_share_of_blocks(to_occupied_[number]),
          to_free,
          to_free * to_free,
          behind == 0 ? 1.0f : 0.0f,
          behind == 0 ? 0.0f : log_share(std::size_t(behind) * std::size_t(behind)),
          std::sqrt(std::max(outside, 0.0f)),
          std::max(outside, 0.0f),
          std::min(outside, 0.0f)};
}

CoarseNormal SurfaceEvidence::normal(const Eigen::Vector3i& block) const {
  if (beside_free_blocks_.at(block))
    if (const Eigen::Vector3i to_free = free_blocks_.ways_to_neighbours(block); !to_free.isZero())
      return CoarseNormal::along(to_free);
  const Eigen::Vector3i middle = block_edge_ * block + offset_ + Eigen::Vector3i::Constant(block_edge_ / 2);
  const auto beyond = [&](int axis) { return hull_.beyond(axis, middle[axis]); };
  int nearest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (beyond(axis) > beyond(nearest)) nearest = axis;
  return CoarseNormal::along(Eigen::Vector3i::Unit(nearest));
}

SurfaceEvidence::Measured SurfaceEvidence::measured(const Eigen::Vector3i& cell) const {
  static const auto logarithms = [] {  // ln(1 + neighbours)
    std::array<float, 27> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::log1p(float(i));
    return all;
  }();
  const Eigen::Vector3i in_whole = cell + offset_;
  const int unmeasured = unmeasured_.neighbours(cell), occupied = occupied_.neighbours(cell);
  const float going_on = going_on_[blocks_.index(block_of(cell))];
  return {1.0f,
          log_odds_of(voxels_.at(in_whole.x(), in_whole.y(), in_whole.z()).probability),
          logarithms[std::size_t(unmeasured)],
          occupied > 0 ? 1.0f : 0.0f,
          float(occupied),
          going_on > 0.0f ? std::log1p(4.0f * going_on) : 0.0f};
}

}  // namespace nextview
