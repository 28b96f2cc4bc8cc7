#include "ui/layers/ray_segments.hpp"

#include <algorithm>

namespace nextview {

std::vector<RaySegment> ray_segments(const ScoreExplanation& explanation, const Vector3& origin, double resolution,
                                     std::size_t count) {
  std::vector<RaySegment> segments;
  const std::size_t all = explanation.rays.size(), stretches = std::min(count, all);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * all / stretches, end = (k + 1) * all / stretches;
    std::size_t most = begin + (end - begin) / 2;
    for (std::size_t i = begin; i < end; ++i)
      if (explanation.rays[i].contribution > explanation.rays[most].contribution) most = i;
    const ScoreExplanation::RayPart& ray = explanation.rays[most];
    if (ray.voxels.empty()) continue;
    const auto& last = ray.voxels.back().lattice;
    const Vector3 centre = (Vector3(last[0], last[1], last[2]) + Vector3::Constant(0.5)) * resolution;
    segments.push_back({origin, origin + ray.direction * (centre - origin).dot(ray.direction), ray.contribution, most});
  }
  return segments;
}

}  // namespace nextview
