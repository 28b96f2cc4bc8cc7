#include "core/planner/scan_overlap.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// Whether a ray comes to measured surface from the side that was seen: what is before it is measured as well.
bool ends_on_scanned(const std::vector<RayVoxel>& visited, double occupancy_threshold) {
  const std::size_t count = visited.size();
  if (count < 2 || !visited[count - 2].measured) return false;
  return visited.back().measured && visited.back().probability >= occupancy_threshold;
}

double rays_on_scanned(const Knowledge& known, const RayCaster& caster, const RayBundle& bundle,
                       const Pose& T_world_camera) {
  std::vector<RayVoxel> visited;
  double count = 0.0;
  for (const Vector3& direction : bundle.directions) {
    caster.cast(T_world_camera.translation(), T_world_camera.linear() * direction, visited);
    count += ends_on_scanned(visited, known.map.model().occupancy_threshold);
  }
  return count;
}

}  // namespace

std::vector<double> scan_overlap(const Knowledge& known, const RayCaster& caster, const RayBundle& bundle,
                                 std::span<const View> views, const std::stop_token& stop) {
  std::vector<Pose> poses;
  for (const View& view : views) poses.push_back(view.T_world_camera);
  for (const TakenView& view : known.taken) poses.push_back(view.T_world_camera);
  std::vector<double> rays(poses.size());
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    if (!stop.stop_requested()) rays[i] = rays_on_scanned(known, caster, bundle, poses[i]);
  });
  throw_if_stopped(stop);
  double of_taken = 0.0;
  for (std::size_t i = views.size(); i < rays.size(); ++i) of_taken += rays[i] / double(known.taken.size());
  rays.resize(views.size());
  for (double& share : rays) share = of_taken > 0.0 ? std::min(1.0, share / of_taken) : 0.0;
  return rays;
}

}  // namespace nextview
