#include "core/source/scan_source.hpp"

#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "core/sensor/depth_camera.hpp"
#include "core/source/recorded_source.hpp"

namespace nextview {
namespace {

/// Gives no scan, for this reason.
class FailingSource : public ScanSource {
 public:
  explicit FailingSource(Failure failure) : failure_(std::move(failure)) {}
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View&, std::uint32_t, std::stop_token) override { return failure_; }

 private:
  SourceDescription description_;
  Failure failure_;
};

/// Measures one point a metre in front of the camera, and remembers where it was asked to look from, and when.
class PointSource : public ScanSource {
 public:
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token) override {
    steps.push_back(step);
    return Capture{std::vector<Vector3>{Vector3::UnitZ()}, view.T_world_camera};
  }

  std::vector<std::uint32_t> steps;

 private:
  SourceDescription description_;
};

/// Views that stand along x and look up: z of the camera is z of the world.
std::vector<View> views_in_a_row(int count) {
  std::vector<View> views(count);
  for (int i = 0; i < count; ++i) views[i].T_world_camera.translation() = Vector3(0.1 * i, 0.0, 0.0);
  return views;
}

TEST(ToScan, SeesAsFarAsTheSensorDoesWhereNothingElseIsSaid) {
  const DepthCameraConfig sensor;
  EXPECT_EQ(sensor.max_range, 1.5);
  EXPECT_EQ(to_scan({std::vector<Vector3>{Vector3::UnitZ()}}, nullptr).scan.max_range, sensor.max_range);
  EXPECT_EQ(SourceDescription().max_range, sensor.max_range);
  EXPECT_EQ(SourceDescription().range_noise, sensor.range_noise);
}

TEST(ToScan, PointsOfTheCameraComeToTheWorldAndNoneIsAMiss) {
  Capture capture{std::vector<Vector3>{{0.0, 0.0, 1.0}, {0.25, 0.0, 0.5}}, make_pose({1, 2, 3}, {0, 1, 0, 0}), 0.75};
  const CapturedScan taken = to_scan(capture, nullptr);  // half a turn around x: y and z point the other way
  EXPECT_EQ(taken.hits, 2u);
  EXPECT_EQ(taken.scan.origin, Vector3(1, 2, 3));
  EXPECT_EQ(taken.scan.max_range, 0.75);
  ASSERT_EQ(taken.scan.hits.size(), 2u);
  EXPECT_LT((taken.scan.hits[0] - Eigen::Vector3f(1.0f, 2.0f, 2.0f)).norm(), 1e-6f);
  EXPECT_LT((taken.scan.hits[1] - Eigen::Vector3f(1.25f, 2.0f, 2.5f)).norm(), 1e-6f);
  EXPECT_TRUE(taken.scan.misses.empty());
}

TEST(ToScan, CountsTheHitsBeforeTheyAreCleaned) {
  CloudConfig cleaning;
  cleaning.outlier_removal = false;
  cleaning.down_sampling = true;
  cleaning.down_sampling_leaf = 0.1;
  const Capture capture{std::vector<Vector3>(7, Vector3(0.05, 0.05, 0.05))};  // all in one leaf
  EXPECT_EQ(to_scan(capture, &cleaning).hits, 7u);
  EXPECT_EQ(to_scan(capture, &cleaning).scan.hits.size(), 1u);
  EXPECT_EQ(to_scan(capture, nullptr).scan.hits.size(), 7u);
}

TEST(TakeScans, TakesTheViewsInTheirOrderAndCountsStepsFromOne) {
  PointSource source;
  const auto scans = take_scans(source, views_in_a_row(3), nullptr);  // nobody asks how far it is
  EXPECT_EQ(source.steps, (std::vector<std::uint32_t>{1, 2, 3}));
  ASSERT_EQ(scans.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(scans[i].origin, Vector3(0.1 * i, 0.0, 0.0));
    ASSERT_EQ(scans[i].hits.size(), 1u);
    EXPECT_LT((scans[i].hits[0] - Eigen::Vector3f(0.1f * float(i), 0.0f, 1.0f)).norm(), 1e-6f);
  }
}

TEST(TakeScans, SaysHowFarItHasComeAndStopsBeforeTheNextView) {
  PointSource source;
  std::vector<double> told;
  std::stop_source stop;
  const Progress progress = [&](double fraction, std::string_view what) {
    EXPECT_EQ(what, "taking the views");
    told.push_back(fraction);
    if (told.size() == 3) stop.request_stop();
  };
  EXPECT_THROW(take_scans(source, views_in_a_row(4), nullptr, progress, stop.get_token()), Stopped);
  EXPECT_EQ(told, (std::vector<double>{0.0, 0.25, 0.5}));
  EXPECT_EQ(source.steps.size(), 2u) << "the third was not to be taken any more";
}

TEST(TakeScans, AStopIsAStopAndAFailureSaysWhy) {
  const std::vector<View> views(2);
  FailingSource stopped({Failure::cancelled, "asked to"}), broken({Failure::no_data, "the lens cap is on"});
  EXPECT_THROW(take_scans(stopped, views, nullptr, {}, {}), Stopped);
  try {
    take_scans(broken, views, nullptr, {}, {});
    FAIL() << "it has no scan";
  } catch (const Stopped&) {
    FAIL() << "nobody stopped it";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the lens cap is on");
  }
}

TEST(RecordedSource, HasItsFramesAndNoOthers) {
  const std::vector<RecordedScan> scans(2);
  RecordedSource source(scans, 1.5);
  const auto is_there = [&](std::optional<std::uint32_t> frame) {
    View view;
    if (frame) view.frame = *frame;
    const Result<Capture> capture = source.capture(view, 1, {});
    const auto* failure = std::get_if<Failure>(&capture);
    EXPECT_TRUE(!failure || failure->kind == Failure::no_data);
    return !failure;
  };
  EXPECT_TRUE(is_there(0) && is_there(1));
  EXPECT_FALSE(is_there(2)) << "there is no third one";
  EXPECT_FALSE(is_there({})) << "a pose of one's own is no frame";
}

}  // namespace
}  // namespace nextview
