#include "core/map/ray_tiles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace nextview {
namespace {

constexpr float tile_width = 0.04f;  // of a tile, across a middle direction
constexpr int tiles_across = 256;    // either way; what lies beyond the outer ones is counted among them

/// Where the rays look, as a sample of them does.
Eigen::Vector3f middle_direction(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends) {
  constexpr std::size_t every = 64;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < ends.size(); i += every) sum += (ends[i] - origin).stableNormalized();
  return sum.allFinite() && sum.norm() > 0.0f ? Eigen::Vector3f(sum.normalized()) : Eigen::Vector3f::UnitX();
}

}  // namespace

PointCloud in_tiles(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends) {
  const Eigen::Vector3f forward = middle_direction(origin, ends), right = forward.unitOrthogonal();
  const Eigen::Vector3f down = forward.cross(right);
  std::vector<std::uint16_t> tile_of(ends.size());
  std::vector<std::size_t> places(std::size_t{tiles_across} * tiles_across + 1);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Eigen::Vector3f way = ends[i] - origin;
    const float per_tile = 1.0f / (tile_width * std::max(way.dot(forward), std::numeric_limits<float>::min()));
    const auto tile = [&](const Eigen::Vector3f& axis) {  // NaN is 0
      return static_cast<int>(
          std::max(0.0f, std::min(way.dot(axis) * per_tile + 0.5f * tiles_across, float{tiles_across - 1})));
    };
    tile_of[i] = static_cast<std::uint16_t>(tile(down) * tiles_across + tile(right));
    ++places[tile_of[i] + std::size_t{1}];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  PointCloud ordered(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) ordered[places[tile_of[i]]++] = ends[i];
  return ordered;
}

}  // namespace nextview
