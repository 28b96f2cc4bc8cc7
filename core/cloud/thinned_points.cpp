#include "core/cloud/thinned_points.hpp"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace nextview {

ThinnedPoints thinned(const PointCloud& points, double spacing) {
  if (!(spacing > 0.0)) throw std::invalid_argument("the spacing of points must be over 0 m");
  std::map<std::array<std::int64_t, 3>, std::uint32_t> at;
  ThinnedPoints result;
  for (const Eigen::Vector3f& p : points) {
    const Vector3 point = p.cast<double>();
    const auto along = [&](int axis) { return std::int64_t(std::floor(point[axis] / spacing)); };
    const auto next = std::uint32_t(result.positions.size());
    const auto [found, is_new] = at.try_emplace({along(0), along(1), along(2)}, next);
    if (is_new) {
      result.positions.emplace_back(Vector3::Zero());
      result.counts.push_back(0);
    }
    Vector3& mean = result.positions[found->second];
    mean += (point - mean) / double(++result.counts[found->second]);
    result.of_point.push_back(found->second);
  }
  return result;
}

}  // namespace nextview
