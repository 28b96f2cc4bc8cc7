#include "core/export/map_calibration_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/configuration.hpp"
#include "core/file/atomic_file.hpp"
#include "core/offline/map_calibration.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SensorModelToml : public InTemporaryFolder {};
class MapCalibrationFiles : public InTemporaryFolder {
 protected:
  void expect_whole_rows(const MapCalibration& calibration) const {
    OutputFolder out = begun(folder_);
    write_map_calibration(calibration, "remark", out);
    for (const std::string file : {"scores.csv", "descent.csv"}) {
      std::istringstream text(read_file(folder_ / file));
      std::string head, line;
      std::getline(text, head);
      std::size_t rows = 0;
      for (; std::getline(text, line); ++rows) {
        std::erase_if(line, [quoted = false](char c) mutable { return c == '"' ? (quoted = !quoted, true) : quoted; });
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ',')) << line;
        EXPECT_THAT(line, Not(HasSubstr("nan")));
      }
      EXPECT_EQ(rows, file == "scores.csv" ? 6u : 2u);
    }
  }
};

InverseSensorModel fitted() {
  InverseSensorModel model;
  model.hit = 0.9123456789012345, model.miss = 1.0 / 3.0, model.hit_decay = -1.25, model.miss_decay = 2.0;
  model.clamp_min = 1e-4, model.clamp_max = 1.0 - 1e-4;
  return model;
}

TEST_F(SensorModelToml, ComesBackToTheLastBitAndSetsNothingElse) {
  write_file(folder_ / "model.toml", sensor_model_toml(fitted(), "first line\nsecond: [map] hit = 0.6"));
  Configuration base;
  base.seed = 77, base.map.resolution = 0.02, base.map.model.free_below = 0.1, base.map.model.occupied_above = 0.9;
  Configuration expected = base;
  expected.map.model = fitted();
  expected.map.model.free_below = 0.1, expected.map.model.occupied_above = 0.9;
  EXPECT_EQ(to_toml(read_configuration(folder_ / "model.toml", base)), to_toml(expected));
  EXPECT_EQ(read_configuration(folder_ / "model.toml", base).map.model, expected.map.model);
}

TEST_F(SensorModelToml, AnyRemarkIsAComment) {
  for (const std::string remark : {"", "\n", "one", "a\n\nb\n", "seed = 5\nseed = 6", "name with \"quotes\" and ü",
                                   "carriage\r\nreturn", "a\ttab"}) {
    write_file(folder_ / "model.toml", sensor_model_toml(fitted(), remark));
    EXPECT_EQ(read_configuration(folder_ / "model.toml").map.model.hit, fitted().hit) << remark;
    EXPECT_EQ(read_configuration(folder_ / "model.toml").seed, Configuration().seed) << remark;
  }
}

TEST_F(MapCalibrationFiles, RowsHaveACellForEachColumnWhateverIsKnown) {
  MapCalibration calibration;
  calibration.fit.model = fitted();
  calibration.fit.descent = {{0.5, 0.1, {}}, {0.25, 0.0, fitted()}};
  ExampleScores unknown, known;
  unknown.name = "scene", unknown.views = 3, unknown.voxels = 10;
  known = unknown;
  known.before = known.after = known.gibbs = MapScores();
  calibration.examples = {unknown, known};
  expect_whole_rows(calibration);
  calibration.examples[0].name = "with, a comma";  // a file may be called so
  expect_whole_rows(calibration);
}

TEST_F(MapCalibrationFiles, AFolderThatIsNotThereIsNamed) {
  OutputFolder out = begun(folder_ / "missing");
  std::filesystem::remove_all(out.path());
  try {
    write_map_calibration({}, "", out);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder_ / "missing").string()));
  }
}

}  // namespace
}  // namespace nextview
