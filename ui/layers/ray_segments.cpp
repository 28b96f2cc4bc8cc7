#include "ui/layers/ray_segments.hpp"

#include <algorithm>

namespace nextview {

std::vector<RaySegment> ray_segments(const ScoreExplanation& explanation, const Vector3& origin, double resolution,
                                     std::size_t count) {
  std::vector<RaySegment> segments;
  // A stride that shares no factor with common row lengths, so that the rays kept do not line up in columns.
  std::size_t stride = explanation.rays.size() / std::max<std::size_t>(count, 1) + 1;
  while (stride > 1 && (stride % 2 == 0 || stride % 19 == 0 || stride % 5 == 0)) ++stride;
  for (std::size_t i = stride / 2; i < explanation.rays.size(); i += stride) {
    const auto& ray = explanation.rays[i];
    if (ray.voxels.empty()) continue;
    const auto& last = ray.voxels.back().lattice;
    const Vector3 centre = (Vector3(last[0], last[1], last[2]) + Vector3::Constant(0.5)) * resolution;
    segments.push_back({origin, origin + ray.direction * (centre - origin).dot(ray.direction), ray.contribution, i});
  }
  return segments;
}

}  // namespace nextview
