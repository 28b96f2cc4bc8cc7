#include "core/export/map_calibration_files.hpp"

#include <fmt/format.h>

#include "core/config/settings_file.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/csv_cell.hpp"
#include "core/file/json_text.hpp"

namespace nextview {
namespace {

std::string descent_csv(const Calibration& fit) {
  std::string csv =
      "iteration,cross_entropy[nats],gradient_norm,hit,miss,hit_decay[1/m],miss_decay[1/m],clamp_min,clamp_max\n";
  for (std::size_t i = 0; i < fit.descent.size(); ++i) {
    const CalibrationStep& s = fit.descent[i];
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", i, s.cross_entropy, s.gradient_norm, s.model.hit, s.model.miss,
                       s.model.hit_decay, s.model.miss_decay, s.model.clamp_min, s.model.clamp_max);
  }
  return csv;
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string scores_csv(const MapCalibration& calibration) {
  std::string csv =
      "object,views,held_out,map,voxels,cross_entropy[nats],log_loss_touch_near_surface[nats],brier_touch_near_surface,"
      "log_loss_centre_near_surface[nats],log_loss_touch_visited[nats],d_kl_touch_visited[nats],surface_recall,"
      "rows_open,opening_recall,leaks\n";
  for (const ExampleScores& e : calibration.examples) {
    const auto row = [&](const char* map, const std::optional<double>& cross_entropy,
                         const std::optional<MapScores>& s) {
      csv += fmt::format("{},{},{},{},{},{}", csv_cell(e.name), e.views, int(e.held_out), map, e.voxels,
                         cell(cross_entropy));
      csv += !s ? ",,,,,,,,,\n"
                : fmt::format(",{},{},{},{},{},{},{},{},{}\n", s->touch_band.log_loss, s->touch_band.brier,
                              s->centre_band.log_loss, s->touch_visited.log_loss, s->touch_visited.divergence,
                              cell(s->surface_recall), cell(s->openings.row_openness()), cell(s->openings.recall()),
                              cell(s->openings.leaks()));
    };
    row("before", e.cross_entropy_before, e.before);
    row("after", e.cross_entropy_after, e.after);
    row("gibbs", e.gibbs_entropy, e.gibbs);
  }
  return csv;
}

std::string calibration_json(const MapCalibration& calibration) {
  nlohmann::ordered_json json = {{"clamps_fitted", calibration.config.fit.clamps},
                                 {"range_dependent", calibration.config.fit.range_dependent},
                                 {"band_voxels", calibration.config.band},
                                 {"cross_entropy_before_nats", calibration.fit.cross_entropy_before},
                                 {"cross_entropy_after_nats", calibration.fit.cross_entropy},
                                 {"converged", calibration.fit.converged},
                                 {"termination", calibration.fit.termination}};
  json["examples"] = nlohmann::ordered_json::array();
  for (const ExampleScores& e : calibration.examples)
    json["examples"].push_back({{"name", e.name},
                                {"views", e.views},
                                {"held_out", e.held_out},
                                {"voxels", e.voxels},
                                {"gibbs_map_stationary", e.gibbs_stationary}});
  return json_text(json, 2) + "\n";
}

}  // namespace

std::string sensor_model_toml(const InverseSensorModel& model, const std::string& remark) {
  InverseSensorModel copy = model;
  std::vector<Setting> fitted;
  for (const Setting& s : settings(copy))
    for (const char* key : {"map.hit", "map.miss", "map.hit_decay", "map.miss_decay", "map.clamp_min", "map.clamp_max"})
      if (s.key == key) fitted.push_back(s);
  return settings_file(fitted, remark);
}

void write_map_calibration(const MapCalibration& calibration, const std::string& remark, OutputFolder& out) {
  write_file(out.claim("sensor_model.toml"), sensor_model_toml(calibration.fit.model, remark));
  write_file(out.claim("calibration.json"), calibration_json(calibration));
  write_file(out.claim("descent.csv"), descent_csv(calibration.fit));
  write_file(out.claim("scores.csv"), scores_csv(calibration));
}

}  // namespace nextview
