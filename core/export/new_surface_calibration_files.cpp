#include "core/export/new_surface_calibration_files.hpp"

#include "core/config/settings_file.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"

namespace nextview {
namespace {

std::string calibration_json(const NewSurfaceCalibration& calibration, const NewSurfaceCalibrationConfig& config,
                             std::uint64_t seed) {
  const nlohmann::ordered_json json = {{"fit", "new-surface"},
                                       {"objects", calibration.objects},
                                       {"views", config.views},
                                       {"seed", seed},
                                       {"resolutions_m", config.resolutions},
                                       {"image_widths_px", config.widths},
                                       {"range_noises_m", config.range_noises},
                                       {"found_in_unmeasured", calibration.found_unmeasured},
                                       {"found_in_free", calibration.found_free},
                                       {"found_in_occupied", calibration.found_occupied},
                                       {"cells", calibration.cells}};
  return json_text(json, 2) + "\n";
}

}  // namespace

void write_new_surface_calibration(const NewSurfaceCalibration& calibration, const NewSurfaceCalibrationConfig& config,
                                   std::uint64_t seed, const std::string& remark, OutputFolder& out) {
  NewSurfaceModel model = calibration.model;
  write_file(out.claim("new_surface.toml"), settings_file(settings(model), remark));
  write_file(out.claim("calibration.json"), calibration_json(calibration, config, seed));
}

}  // namespace nextview
