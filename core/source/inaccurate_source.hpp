#pragma once
#include <memory>

#include "core/robot/pose_error.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// A simulated source whose camera is not where the robot believes it to be: it senses from there, and its captures
/// carry the pose that is believed. The robot needs no part in it, since it believes that it went where it was sent.
class InaccurateSource : public ScanSource {
 public:
  /// @throws std::invalid_argument if the configuration is not valid.
  InaccurateSource(std::unique_ptr<ScanSource> simulated, const RobotConfig& config, std::uint64_t seed);
  const SourceDescription& describe() const override { return simulated_->describe(); }
  /// The same view, step and seed give the same bytes.
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override;

 private:
  std::unique_ptr<ScanSource> simulated_;
  RobotConfig config_;
  std::uint64_t seed_;
};

}  // namespace nextview
