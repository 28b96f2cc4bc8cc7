#pragma once
#include "core/recording/recording.hpp"
#include "core/sensor/recorded_scans.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// Scans that were taken elsewhere: its frames, in their order.
class RecordedSource : public ScanSource {
 public:
  explicit RecordedSource(Recording recording);
  /// Points farther off than `max_range` [m] end nowhere; `camera` is what views are scored with.
  RecordedSource(std::vector<RecordedScan> scans, double max_range, const PinholeCamera& camera = {});
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override;

  const Recording& recording() const { return recording_; }

 private:
  Recording recording_;
  SourceDescription description_;
};

}  // namespace nextview
