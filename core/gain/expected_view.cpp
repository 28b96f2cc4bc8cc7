#include "core/gain/expected_view.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

namespace nextview {
ExpectedView expected_view(const MapRays& rays, const Pose& T_world_camera, const PinholeCamera& camera, int columns,
                           int rows) {
  if (columns < 1 || rows < 1) throw std::invalid_argument("expected view: columns and rows must be over 0");
  const std::vector<Vector3> directions = RayBundle::regular(camera, columns, rows).directions;
  ExpectedView view{columns, rows, std::vector<float>(directions.size(), -1.0f),
                    std::vector<std::uint8_t>(directions.size(), 0)};
  const Vector3 origin = T_world_camera.translation();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, directions.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const RayEnd end = rays.end(origin, T_world_camera.linear() * directions[i]);
      view.unknown[i] = end.crosses_unmeasured;
      if (end.range >= 0.0) view.depth[i] = static_cast<float>(end.range * directions[i].z());
    }
  });
  return view;
}

}  // namespace nextview
