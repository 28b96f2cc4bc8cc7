#include "tests/benchmarks/planning_step.hpp"

#include "core/gain/new_surface.hpp"
#include "core/gain/view_score.hpp"

namespace nextview {
namespace {

DepthCameraConfig camera_of(DepthCameraConfig sensor, int width) {
  sensor.width = width;
  sensor.height = width * 3 / 4;
  return sensor;
}

std::vector<Pose> views_around(CandidateViewsConfig views, int count) {
  views.count = count;
  return candidate_views(views, Vector3::Zero());
}

}  // namespace

PlanningStep::PlanningStep(const PlanningStepSize& size)
    : camera(camera_of(configuration.sensor, size.width)),
      candidates(views_around(configuration.views, size.candidates)),
      bundle(RayBundle::regular(DepthCamera(configuration.sensor).camera())),
      map(region_of_interest(Vector3::Zero(), 1.28, size.resolution), InverseSensorModel{}),
      scan(sense(next_view)) {
  for (const int view : views_before(size.views_before)) map.insert(sense(view));
}

std::vector<int> PlanningStep::views_before(int count) {
  std::vector<int> views;
  for (int v = 0; v < count; ++v) views.push_back(9 * v % 48);
  return views;
}

Pose PlanningStep::view(int number) const { return views_around(configuration.views, 48)[number]; }

Scan PlanningStep::sense(int view) const {
  const Pose at = this->view(view);
  return back_project(camera.sense(scene, at, 1, view), at, max_range);
}

std::vector<Eigen::Vector3f> PlanningStep::image_rays(int view) const {
  const Pose at = this->view(view);
  std::vector<Eigen::Vector3f> rays;
  for (int v = 0; v < camera.config().height; ++v)
    for (int u = 0; u < camera.config().width; ++u)
      rays.push_back((at.linear() * camera.camera().direction(u, v)).cast<float>());
  return rays;
}

void PlanningStep::score() {
  const Gain* const gain = &nextview::gain("occlusion-aware");
  const MapRays rays(map.grid(), map.voxels(), map.model().occupancy_threshold, max_range);
  voxel_steps = 0;
  for (const ViewScore& view : score_views(rays, candidates, bundle, {&gain, 1})) voxel_steps += view.voxels;
}

void PlanningStep::score_new_surface() const {
  const SurfaceEvidence evidence(map.grid(), map.voxels(), map.voxels(), map.model().occupancy_threshold);
  forecast_new_surface({evidence, NewSurfaceModel::fitted()}, candidates, bundle, {});
}

}  // namespace nextview
