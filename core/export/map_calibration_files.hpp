#pragma once
#include <string>

#include "core/offline/map_calibration.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {

/// The sensor model as a configuration file that sets nothing else; `remark` becomes a comment.
std::string sensor_model_toml(const InverseSensorModel& model, const std::string& remark);

/// Writes sensor_model.toml, calibration.json (what was fitted to what, and how it ended), descent.csv (each iteration
/// of BFGS) and scores.csv (each example before, after, and its Gibbs map). @pre out.begin() was called. @throws
/// std::runtime_error naming the file and the reason.
void write_map_calibration(const MapCalibration& calibration, const std::string& remark, OutputFolder& out);

}  // namespace nextview
