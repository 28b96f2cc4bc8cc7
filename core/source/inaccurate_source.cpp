#include "core/source/inaccurate_source.hpp"

namespace nextview {

InaccurateSource::InaccurateSource(std::unique_ptr<ScanSource> simulated, const RobotConfig& config, std::uint64_t seed)
    : simulated_(std::move(simulated)), config_(config), seed_(seed) {
  config_.validate();
}

Result<Capture> InaccurateSource::capture(const View& view, std::uint32_t step, std::stop_token stop) {
  const Pose T_world_true = view.T_world_camera * pose_error(config_, seed_, step);
  Result<Capture> result = simulated_->capture({T_world_true, view.frame}, step, stop);
  if (auto* capture = std::get_if<Capture>(&result)) capture->T_world_camera = view.T_world_camera;
  return result;
}

}  // namespace nextview
