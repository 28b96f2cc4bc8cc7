#include "core/gain/surface_evidence.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/map/distance_transform.hpp"

namespace nextview {
namespace {

/// How far around the object's box voxels are looked at, as a share of its size: farther off, next to nothing is found.
constexpr double margin = 0.12;
constexpr double outlier_share = 0.001;

using Kind = SurfaceEvidence::Kind;

const std::array<Eigen::Vector3i, 9> hull_directions = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};

bool is_occupied(const Voxel& voxel, double threshold) { return voxel.measured && voxel.probability >= threshold; }

/// Where the occupied voxels are, in the order of the bricks.
std::vector<Eigen::Vector3i> occupied_cells(const VoxelBricks& voxels, double threshold) {
  std::vector<std::vector<Eigen::Vector3i>> of_brick(voxels.brick_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.brick_count(), 64), [&](const auto& range) {
    for (std::size_t brick = range.begin(); brick != range.end(); ++brick) {
      const VoxelBricks::Brick& all = *voxels.bricks()[brick];
      if (all.is_uniform() && !is_occupied(all[0], threshold)) continue;
      for (std::size_t i = 0; i < VoxelBricks::brick_voxels; ++i)
        if (all.measured(i) && is_occupied(all[i], threshold))
          of_brick[brick].push_back(voxels.cell(brick * VoxelBricks::brick_voxels + i));
    }
  });
  std::vector<Eigen::Vector3i> cells;
  for (const auto& some : of_brick) cells.insert(cells.end(), some.begin(), some.end());
  return cells;
}

/// The range of the values without the outliers at both ends.
std::pair<int, int> bounds(std::vector<int>& values) {
  const auto outliers = static_cast<std::ptrdiff_t>(outlier_share * double(values.size()));
  const auto low = values.begin() + outliers, high = values.end() - 1 - outliers;
  std::nth_element(values.begin(), low, values.end());
  const int lowest = *low;
  std::nth_element(values.begin(), high, values.end());
  return {lowest, *high};
}

}  // namespace

double SurfaceEvidence::Hull::outside(const Eigen::Vector3i& cell) const {
  constexpr double of_diagonal = std::numbers::sqrt2 / 2;
  double outside = -std::numeric_limits<double>::infinity();
  for (int d = 0; d < directions; ++d) {
    const int along = hull_directions[d].dot(cell);
    const double beyond = std::max(along - highest[d], lowest[d] - along);
    outside = std::max(outside, d < 3 ? beyond : of_diagonal * beyond);
  }
  return outside;
}

SurfaceEvidence::Hull SurfaceEvidence::hull_of(const std::vector<Eigen::Vector3i>& occupied) {
  Hull hull;
  std::vector<int> along(occupied.size());
  for (int d = 0; d < Hull::directions; ++d) {
    std::transform(occupied.begin(), occupied.end(), along.begin(),
                   [&](const Eigen::Vector3i& cell) { return hull_directions[d].dot(cell); });
    std::tie(hull.lowest[d], hull.highest[d]) = bounds(along);
  }
  return hull;
}

SurfaceEvidence::SurfaceEvidence(const VoxelGrid& grid, const VoxelBricks& voxels, const VoxelBricks& occlusions,
                                 double occupancy_threshold)
    : grid_{grid.resolution, grid.first, Eigen::Vector3i::Zero()} {
  const std::vector<Eigen::Vector3i> occupied = occupied_cells(voxels, occupancy_threshold);
  if (occupied.empty()) return;
  hull_ = hull_of(occupied);
  set_region(grid, hull_);
  read_voxels(voxels, occlusions, occupancy_threshold);
  measure_distances();
}

void SurfaceEvidence::set_region(const VoxelGrid& whole, const Hull& hull) {
  const Eigen::Vector3i lowest(hull.lowest[0], hull.lowest[1], hull.lowest[2]);
  const Eigen::Vector3i highest(hull.highest[0], hull.highest[1], hull.highest[2]);
  const Eigen::Vector3i edges = highest - lowest + Eigen::Vector3i::Ones();
  size_ = edges.cast<double>().norm();
  object_ = {(whole.first + lowest).cast<double>() * whole.resolution,
             (whole.first + highest + Eigen::Vector3i::Ones()).cast<double>() * whole.resolution};
  const Eigen::Vector3i around = Eigen::Vector3i::Constant(static_cast<int>(std::ceil(margin * size_)) + 1);
  offset_ = (lowest - around).cwiseMax(0);
  grid_.first = whole.first + offset_;
  grid_.size = (highest + around + Eigen::Vector3i::Ones()).cwiseMin(whole.size) - offset_;
}

void SurfaceEvidence::read_voxels(const VoxelBricks& voxels, const VoxelBricks& occlusions, double threshold) {
  const std::size_t count = grid_.voxel_count();
  kinds_.resize(count);
  log_odds_.resize(count);
  behind_.resize(count);
  tbb::parallel_for(0, grid_.size.z(), [&](int z) {
    std::size_t i = std::size_t(z) * grid_.size.y() * grid_.size.x();
    float last = 0.5f, its_log_odds = 0.0f;  // neighbours are often alike
    for (int y = 0; y < grid_.size.y(); ++y)
      for (int x = 0; x < grid_.size.x(); ++x, ++i) {
        const Voxel& voxel = voxels.at(x + offset_.x(), y + offset_.y(), z + offset_.z());
        kinds_[i] = is_occupied(voxel, threshold) ? Kind::occupied : voxel.measured ? Kind::free : Kind::unmeasured;
        // Of its probability: other maps than the conventional one have no log-odds.
        if (voxel.probability != last) {
          last = voxel.probability;
          its_log_odds = static_cast<float>(log_odds(std::clamp(double(last), 1e-3, 1 - 1e-3)));
        }
        if (voxel.measured)
          log_odds_[i] = its_log_odds;
        else
          behind_[i] = occlusions.at(x + offset_.x(), y + offset_.y(), z + offset_.z()).occlusion_distance;
      }
  });
}

void SurfaceEvidence::measure_distances() {
  const auto are = [&](Kind kind) {
    std::vector<std::uint8_t> of_kind(kinds_.size());
    std::transform(kinds_.begin(), kinds_.end(), of_kind.begin(), [&](Kind k) { return k == kind; });
    return of_kind;
  };
  tbb::parallel_invoke(
      [&] {
        const auto occupied = are(Kind::occupied);
        to_occupied_ = squared_distances(occupied, grid_.size);
        occupied_around_ = neighbour_counts(occupied, grid_.size);
      },
      [&] { to_free_ = squared_distances(are(Kind::free), grid_.size); },
      [&] { unmeasured_around_ = neighbour_counts(are(Kind::unmeasured), grid_.size); });
  // Nothing is farther off than the object is large, or its margin is wide.
  const auto farthest = static_cast<std::size_t>(size_ * size_) + 2;
  for (std::size_t squared = 0; squared < farthest; ++squared)
    log_shares_.push_back(static_cast<float>(0.5 * std::log(std::max<double>(1.0, double(squared))) - std::log(size_)));
}

float SurfaceEvidence::log_share(std::int32_t squared_distance) const {
  return log_shares_[std::min<std::size_t>(std::size_t(squared_distance), log_shares_.size() - 1)];
}

SurfaceEvidence::Unmeasured SurfaceEvidence::unmeasured(std::size_t voxel) const {
  const Eigen::Vector3i cell = grid_.cell(static_cast<std::uint32_t>(voxel)) + offset_;
  const float to_free = log_share(to_free_[voxel]);
  const std::int32_t behind = std::min<std::int32_t>(behind_[voxel], 10000);
  const auto outside = static_cast<float>(hull_.outside(cell) / size_);
  return {1.0f,
          log_share(to_occupied_[voxel]),
          to_free,
          to_free * to_free,
          behind == 0 ? 1.0f : 0.0f,
          behind == 0 ? 0.0f : log_share(behind * behind),
          std::sqrt(std::max(outside, 0.0f)),
          std::max(outside, 0.0f),
          std::min(outside, 0.0f)};
}

SurfaceEvidence::Measured SurfaceEvidence::measured(std::size_t voxel) const {
  return {1.0f, log_odds_[voxel], std::log1p(float(unmeasured_around_[voxel])),
          occupied_around_[voxel] > 0 ? 1.0f : 0.0f, float(occupied_around_[voxel])};
}

}  // namespace nextview
