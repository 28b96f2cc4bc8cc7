#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/options.hpp"
#include "app/commands/recorded_input.hpp"
#include "core/offline/map_calibration.hpp"
#include "core/offline/new_surface_calibration.hpp"

namespace nextview {

struct CalibrateArguments {
  ConfigurationOptions options;
  RangeScanOptions range_scans;
  MapCalibrationConfig config;
  std::vector<std::string> fitted = {"bunny", "slotted_plate"};
  std::vector<std::string> held_out = {"gearbox", "slotted_housing"};
  bool fitted_given = false, held_out_given = false, views_given = false, parts_given = false;
  std::vector<int> views = {4, 20};
  int parts = 24;  ///< made up, where no object is given
  std::string out = "calibration";
  bool no_pictures = false;
};

/// Whether an input is finished scans; otherwise it is an object. A name that the program knows is the object, also
/// where there is a folder of this name (./NAME is the folder).
bool is_recorded(const std::string& input);
/// The file or folder that an input means: the same for two spellings of one. @throws std::invalid_argument if it has
/// no name, std::runtime_error if there is no such object.
std::filesystem::path input_path(const std::string& input);

/// What `calibrate` does, by --fit. @return the exit code.
int fit_sensor_model(const CalibrateArguments& arguments);
int fit_new_surface(const CalibrateArguments& arguments);

}  // namespace nextview
