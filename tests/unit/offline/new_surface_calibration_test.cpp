#include "core/offline/new_surface_calibration.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "core/progress/stopped.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

const std::vector<TrainingObject>& two_parts() {
  static const std::vector<TrainingObject> parts = training_objects(2, 1);
  return parts;
}

NewSurfaceCalibrationConfig quick() {
  NewSurfaceCalibrationConfig config;
  config.views = 3;
  config.resolutions = {0.02};
  config.widths = {80};
  return config;
}

NewSurfaceCalibration calibrated(std::size_t threads, const Progress& progress = {}) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  return calibrate_new_surface(two_parts(), small_scan(), quick(), progress);
}

TEST(NewSurfaceCalibration, PartsHaveNamesAndAreWatertight) {
  ASSERT_EQ(two_parts().size(), 2u);
  EXPECT_NE(two_parts()[0].name, two_parts()[1].name);
  for (const TrainingObject& part : two_parts()) {
    EXPECT_FALSE(part.object->mesh.triangles.empty());
    EXPECT_TRUE(part.object->topology.watertight());
  }
  EXPECT_TRUE(training_objects(0, 1).empty());
}

TEST(NewSurfaceCalibration, TheSameOnOneThreadAndTwo) {
  std::vector<double> fractions;
  const NewSurfaceCalibration one = calibrated(1, [&](double fraction, std::string_view what) {
    EXPECT_FALSE(what.empty());
    fractions.push_back(fraction);
  });
  const NewSurfaceCalibration two = calibrated(2);
  EXPECT_EQ(one.model, two.model);
  EXPECT_EQ(one.cells, two.cells);
  EXPECT_EQ(one.found_unmeasured, two.found_unmeasured);
  EXPECT_EQ(one.found_free, two.found_free);
  EXPECT_EQ(one.found_occupied, two.found_occupied);

  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_EQ(one.objects, (std::vector<std::string>{two_parts()[0].name, two_parts()[1].name}));
  EXPECT_GT(one.cells, 100u);
  EXPECT_NEAR(one.found_unmeasured + one.found_free + one.found_occupied, 1.0, 1e-12);
  for (const double share : {one.found_unmeasured, one.found_free, one.found_occupied}) EXPECT_GT(share, 0.0);
  EXPECT_GT(one.model.mean_slant, 1.0);
  EXPECT_LT(one.model.mean_slant, 3.0);
  EXPECT_GT(one.model.slant.edge_on, one.model.slant.face_on) << "flat surface is met on edge";
  NewSurfaceModel model = one.model;
  for (const Setting& setting : settings(model)) EXPECT_NO_THROW(setting.require_in_bounds()) << setting.key;
}

// Whose rays are followed is known before the first view; views that are made later are none of them.
TEST(NewSurfaceCalibration, LearnsFromViewsThatStay) {
  Configuration sphere = small_scan(), adaptive = small_scan();
  adaptive.views.layout = ViewLayout::adaptive;
  EXPECT_EQ(calibrate_new_surface(two_parts(), adaptive, quick()).model,
            calibrate_new_surface(two_parts(), sphere, quick()).model);
}

TEST(NewSurfaceCalibration, NothingToLearnFromIsRefused) {
  EXPECT_THROW(calibrate_new_surface({}, small_scan(), quick()), std::invalid_argument);
}

TEST(NewSurfaceCalibration, AStopThrows) {
  std::stop_source before;
  before.request_stop();
  EXPECT_THROW(calibrate_new_surface(two_parts(), small_scan(), quick(), {}, before.get_token()), Stopped);
  std::stop_source at_the_second;
  const Progress stop = [&](double fraction, std::string_view) {
    if (fraction > 0.0) at_the_second.request_stop();
  };
  EXPECT_THROW(calibrate_new_surface(two_parts(), small_scan(), quick(), stop, at_the_second.get_token()), Stopped);
}

}  // namespace
}  // namespace nextview
