#include "core/source/simulated_source.hpp"

#include "core/progress/stopped.hpp"

namespace nextview {

SimulatedWorld::SimulatedWorld(std::shared_ptr<const PlacedMesh> placed, const DepthCameraConfig& sensor,
                               const std::stop_token& stop)
    : object(std::move(placed)), scene(object->surroundings(), stop), camera(sensor, stop) {}

SimulatedSource::SimulatedSource(std::shared_ptr<const SimulatedWorld> world, std::uint64_t seed)
    : world_(std::move(world)), seed_(seed) {
  const DepthCameraConfig& sensor = world_->camera.config();
  description_ = {world_->camera.camera(), sensor.max_range, sensor.range_noise};
}

Result<Capture> SimulatedSource::capture(const View& view, std::uint32_t step, std::stop_token stop) try {
  return Capture{world_->camera.sense(world_->scene, view.T_world_camera, seed_, step, stop), view.T_world_camera,
                 description_.max_range};
} catch (const Stopped&) {
  return Failure{Failure::cancelled, "the capture was cancelled"};
}

}  // namespace nextview
