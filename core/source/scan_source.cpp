#include "core/source/scan_source.hpp"

#include <stdexcept>

#include "core/progress/stopped.hpp"

namespace nextview {

CapturedScan to_scan(const Capture& capture, const CloudConfig* cleaning, const std::stop_token& stop) {
  CapturedScan captured;
  Scan& scan = captured.scan;
  if (const auto* image = std::get_if<DepthImage>(&capture.measured)) {
    scan = back_project(*image, capture.T_world_camera, capture.max_range, stop);
  } else {
    scan.origin = capture.T_world_camera.translation();
    scan.max_range = capture.max_range;
    for (const Vector3& point : std::get<std::vector<Vector3>>(capture.measured))
      scan.hits.push_back((capture.T_world_camera * point).cast<float>());
  }
  captured.hits = scan.hits.size();
  if (cleaning) scan.hits = clean(scan.hits, *cleaning, stop);
  return captured;
}

std::vector<Scan> take_scans(ScanSource& source, std::span<const View> views, const CloudConfig* cleaning,
                             const Progress& progress, const std::stop_token& stop) {
  std::vector<Scan> scans;
  for (std::uint32_t k = 0; k < views.size(); ++k) {
    if (progress) progress(double(k) / double(views.size()), "taking the views");
    throw_if_stopped(stop);
    const Result<Capture> capture = source.capture(views[k], k + 1, stop);
    if (const auto* failure = std::get_if<Failure>(&capture)) {
      if (failure->kind == Failure::cancelled) throw Stopped();
      throw std::runtime_error(failure->reason);
    }
    scans.push_back(to_scan(std::get<Capture>(capture), cleaning, stop).scan);
  }
  return scans;
}

}  // namespace nextview
