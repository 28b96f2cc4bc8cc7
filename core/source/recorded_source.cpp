#include "core/source/recorded_source.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace nextview {
namespace {

Recording recording_of(std::vector<RecordedScan> scans, double max_range, const PinholeCamera& camera) {
  Recording recording;
  recording.format = "scene";
  recording.camera = camera;
  recording.max_range = max_range;
  const auto all = std::make_shared<const std::vector<RecordedScan>>(std::move(scans));
  for (std::size_t k = 0; k < all->size(); ++k)
    recording.frames.push_back(
        {fmt::format("scan {}", k + 1), (*all)[k].T_world_camera, [all, k] { return Measured((*all)[k].points); }});
  return recording;
}

}  // namespace

RecordedSource::RecordedSource(Recording recording) : recording_(std::move(recording)) {
  description_ = {recording_.camera, recording_.max_range, 0.0};
  description_.region = recording_.region;
  for (const RecordedFrame& frame : recording_.frames)
    description_.frames.push_back({frame.T_world_camera, std::uint32_t(description_.frames.size())});
}

RecordedSource::RecordedSource(std::vector<RecordedScan> scans, double max_range, const PinholeCamera& camera)
    : RecordedSource(recording_of(std::move(scans), max_range, camera)) {}

Result<Capture> RecordedSource::capture(const View& view, std::uint32_t, std::stop_token) try {
  const auto& frames = recording_.frames;
  if (!view.frame || *view.frame >= frames.size())
    return Failure{Failure::no_data, fmt::format("the recording has {} frames, and none from there", frames.size())};
  const RecordedFrame& frame = frames[*view.frame];
  return Capture{frame.read(), frame.T_world_camera, description_.max_range};
} catch (const std::runtime_error& error) {
  return Failure{Failure::no_data, error.what()};
}

}  // namespace nextview
