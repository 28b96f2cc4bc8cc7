#include "core/gain/surface_slant.hpp"

#include <array>
#include <numeric>
#include <vector>

namespace nextview {
namespace {

std::vector<Vector3> all_directions() {
  std::vector<Vector3> directions = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  for (int x = 0; x <= 2; ++x)
    for (int y = x > 0 ? -2 : 0; y <= 2; ++y)
      for (int z = x > 0 || y > 0 ? -2 : 1; z <= 2; ++z)
        if (std::gcd(x, std::gcd(y, z)) == 1 && x * x + y * y + z * z > 1)
          directions.push_back(Vector3(x, y, z).normalized());
  return directions;
}

constexpr int ways = 2 * CoarseNormal::farthest + 1;  // along each axis

std::size_t place_of(const Eigen::Vector3i& way) {
  const Eigen::Vector3i from = way.array() + CoarseNormal::farthest;
  return (std::size_t(from.z()) * ways + std::size_t(from.y())) * ways + std::size_t(from.x());
}

using NearestOfWays = std::array<std::uint8_t, std::size_t{ways} * ways * ways>;

NearestOfWays nearest_of_all_ways(const std::vector<Vector3>& directions) {
  NearestOfWays nearest{};
  for (int z = 0; z < ways; ++z)
    for (int y = 0; y < ways; ++y)
      for (int x = 0; x < ways; ++x) {
        const Eigen::Vector3i way = Eigen::Vector3i(x, y, z).array() - CoarseNormal::farthest;
        constexpr double rounding = 1e-9;
        double most = 0.0;
        for (std::size_t d = 0; d < directions.size(); ++d) {
          const double along = std::abs(directions[d].dot(way.cast<double>()));
          if (along <= most + rounding) continue;
          most = along;
          nearest[place_of(way)] = static_cast<std::uint8_t>(d);
        }
      }
  return nearest;
}

}  // namespace

const std::vector<Vector3> CoarseNormal::directions = all_directions();

CoarseNormal CoarseNormal::along(const Eigen::Vector3i& way) {
  static const NearestOfWays nearest = nearest_of_all_ways(directions);
  CoarseNormal normal;
  normal.number_ = nearest[place_of(way)];
  return normal;
}

}  // namespace nextview
