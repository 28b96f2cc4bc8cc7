#include "tests/benchmarks/simulated_views.hpp"

#include "core/view/candidate_views.hpp"

namespace nextview {

SimulatedViews simulate_views(const TriangleMesh& mesh, const DepthCameraConfig& config, int count) {
  const MeshRayCaster scene(mesh);
  const DepthCamera camera(config);
  CandidateViewsConfig layout;
  layout.layout = ViewLayout::fibonacci;
  layout.count = count;
  SimulatedViews views;
  for (const Pose& pose : candidate_views(layout, Vector3::Zero())) {
    const auto number = static_cast<std::uint32_t>(views.scans.size() + 1);
    views.scans.push_back(back_project(camera.sense(scene, pose, 1, number), pose, config.max_range));
    views.ideal.push_back(back_project(camera.sense_ideal(scene, pose), pose, config.max_range));
  }
  return views;
}

}  // namespace nextview
