#include "core/export/new_surface_calibration_files.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file/read_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"

namespace nextview {
namespace {

using NewSurfaceCalibrationFiles = InTemporaryFolder;

NewSurfaceCalibration learned() {
  NewSurfaceCalibration calibration;
  double value = -1.0 / 3.0;
  for (const Setting& s : settings(calibration.model)) *std::get<double*>(s.value) = value *= -1.3;
  calibration.model.mean_slant = 5.0 / 3.0, calibration.model.slant = {7.0 / 3.0, 4.0 / 3.0};
  calibration.objects = {"part 0", "a \"name\",\nof two lines"};
  calibration.found_unmeasured = 0.7, calibration.found_free = 0.2, calibration.found_occupied = 0.1;
  calibration.cells = 77;
  return calibration;
}

TEST_F(NewSurfaceCalibrationFiles, TheCoefficientsComeBackToTheLastBitAndNothingElseIsSet) {
  OutputFolder out = begun(folder_);
  write_new_surface_calibration(learned(), {}, 5, "first line\nsecond: [planner] gain = \"random\"", out);
  Configuration base;
  base.seed = 77, base.planner.gain = "random";
  const Configuration read = read_configuration(folder_ / "new_surface.toml", base);
  EXPECT_EQ(read.planner.new_surface, learned().model);
  base.planner.new_surface = learned().model;
  EXPECT_EQ(to_toml(read), to_toml(base));
}

TEST_F(NewSurfaceCalibrationFiles, TheNumbersSayWhatItWasLearnedFrom) {
  OutputFolder out = begun(folder_);
  write_new_surface_calibration(learned(), {.views = 4, .resolutions = {0.02}, .widths = {80, 90}, .range_noises = {0}},
                                5, "remark", out);
  const auto json = nlohmann::json::parse(read_file(folder_ / "calibration.json"));
  EXPECT_EQ(json.at("fit"), "new-surface");
  EXPECT_EQ(json.at("objects"), learned().objects);
  EXPECT_EQ(json.at("views"), 4);
  EXPECT_EQ(json.at("seed"), 5);
  EXPECT_EQ(json.at("resolutions_m"), (std::vector{0.02}));
  EXPECT_EQ(json.at("image_widths_px"), (std::vector{80, 90}));
  EXPECT_EQ(json.at("range_noises_m"), (std::vector{0.0}));
  EXPECT_EQ(json.at("found_in_unmeasured"), 0.7);
  EXPECT_EQ(json.at("found_in_free"), 0.2);
  EXPECT_EQ(json.at("found_in_occupied"), 0.1);
  EXPECT_EQ(json.at("cells"), 77);
}

}  // namespace
}  // namespace nextview
