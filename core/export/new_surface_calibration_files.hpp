#pragma once
#include <string>

#include "core/offline/new_surface_calibration.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {

/// Writes new_surface.toml, a configuration file of the coefficients alone with `remark` as a comment, and
/// calibration.json: what they were learned from, and where new surface was found. `config` and `seed` as it was
/// called with. @pre out.begin() was called. @throws std::runtime_error naming the file and the reason.
void write_new_surface_calibration(const NewSurfaceCalibration& calibration, const NewSurfaceCalibrationConfig& config,
                                   std::uint64_t seed, const std::string& remark, OutputFolder& out);

}  // namespace nextview
