#include "core/source/recorded_source.hpp"

#include <fmt/format.h>

namespace nextview {

RecordedSource::RecordedSource(std::vector<RecordedScan> scans, double max_range, const PinholeCamera& camera)
    : scans_(std::move(scans)), description_{camera, max_range, 0.0} {
  for (std::uint32_t k = 0; k < scans_.size(); ++k) description_.frames.push_back({scans_[k].T_world_camera, k});
  if (!scans_.empty()) description_.start = scans_.front().T_world_camera;
}

Result<Capture> RecordedSource::capture(const View& view, std::uint32_t, std::stop_token) {
  if (!view.frame || *view.frame >= scans_.size())
    return Failure{Failure::no_data, fmt::format("the recording has {} scans, and none from there", scans_.size())};
  const RecordedScan& scan = scans_[*view.frame];
  return Capture{scan.points, scan.T_world_camera, description_.max_range};
}

}  // namespace nextview
