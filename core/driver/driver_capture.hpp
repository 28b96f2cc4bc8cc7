#pragma once
#include <stdexcept>

#include "core/driver/driver_protocol.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// A capture is whole, and nothing was in sight: from elsewhere, or later, there may be.
class NothingMeasured : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads what a driver says that it captured: by its name's ending
///  - .npy: float32 (or float64) ranges along the ray [m], height x width; inf: beyond range, NaN: invalid
///  - .png: 16-bit grey values, times `scale` [m], of what it `measures` (z or range); 0: invalid
///  - .ply: points in the camera frame [m]
/// @param folder of the request
/// @throws std::runtime_error naming the file and the reason: missing, no regular file, damaged, another size than
///         `camera` has, values that are no ranges or mostly far beyond `max_range`; NothingMeasured
Capture read_capture(const CapturedFile& captured, const std::filesystem::path& folder, const PinholeCamera& camera,
                     double max_range);

}  // namespace nextview
