// What the Inspector says of a ray and of a voxel.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;

class InspectorPanel : public testing::Test {
 protected:
  InspectorPanel() {
    desk_.snapshot = scan_;
    desk_.window.bring_to_front(panel_name::inspector);
  }
  std::string panel() {
    desk_.frames();
    return read("Inspector");
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_;
};

/// A ray along -z through voxels of 40 mm, from a camera 0.5 m above the middle of the uppermost of them.
ViewInspection view_of_a_ray() {
  ScoreExplanation e;
  e.rays.resize(3);
  e.value = 50;
  e.rays[1].direction = -Vector3::UnitZ();
  e.rays[1].contribution = 12.5;
  e.rays[1].voxels = {
      {{2, 3, 4}, false, 0.5, 1, 2.5}, {{2, 3, 3}, true, 0.75, 0.5, 10}, {{2, 3, 2}, true, 0.125, 0.25, 0}};
  ViewInspection view;
  view.T_world_camera.translation() = Vector3(0.1, 0.14, 0.18 + 0.5);
  view.explanation = std::make_shared<const ScoreExplanation>(e);
  return view;
}

TEST_F(InspectorPanel, ARaysVoxelsStandAtTheirDistancesInMillimetres) {
  desk_.inspection.view = view_of_a_ray();
  desk_.window.selection.ray = 1;
  const std::string text = panel();
  EXPECT_THAT(text, HasSubstr("Ray 1 of 3"));
  EXPECT_THAT(text, HasSubstr("It contributes 12.5 nats of the view's 50 nats (25.00 %): the sum over its 3 voxels."));
  EXPECT_THAT(text, HasSubstr("at [mm] p visibility adds [nats] "
                              "500 unseen 1.000 2.5 540 0.750 0.500 10 580 0.125 0.250 0 at: distance"));
  // Bars: shares of the largest. The column's width is that of the longest one.
  const auto bars = seen_areas(mix(theme::chosen, theme::paper, 0.75), "Inspector");
  ASSERT_EQ(bars.size(), 2u) << "nothing has no bar";
  EXPECT_NEAR(bars[0].GetWidth(), 0.25f * bars[1].GetWidth(), 1.5f);
}

TEST_F(InspectorPanel, SmallVoxelsStandAtTenthsOfAMillimetre) {
  desk_.inspection.view = view_of_a_ray();
  desk_.window.selection.ray = 1;
  scan_->grid.resolution = 0.001;
  EXPECT_THAT(panel(), HasSubstr("675.5 unseen 1.000 2.5 676.5 0.750"));
}

TEST_F(InspectorPanel, AClickOnARaysVoxelInspectsItsCentre) {
  desk_.inspection.view = view_of_a_ray();
  desk_.window.selection.ray = 1;
  desk_.frames();
  const auto calls = click_on(desk_, "540", "Inspector");
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(calls[0].command->name, "inspect-voxel");
  const auto values = calls[0].values();
  const Vector3 centre(std::stod(values[0]), std::stod(values[1]), std::stod(values[2]));
  EXPECT_LT((centre - Vector3(0.1, 0.14, 0.14)).norm(), 1e-9) << text_of(calls);
}

TEST_F(InspectorPanel, ARayThatIsNotThereSaysSo) {
  desk_.inspection.view = view_of_a_ray();
  desk_.window.selection.ray = 3;
  EXPECT_THAT(panel(), HasSubstr("The view has no ray of this number."));
  desk_.window.selection.ray = 0;
  EXPECT_THAT(panel(), HasSubstr("It misses the region of interest."));
  desk_.window.selection.ray.reset();
  EXPECT_THAT(panel(), HasSubstr("Nothing is picked"));
}

class InspectedVoxel : public InspectorPanel {
 protected:
  InspectedVoxel() {
    auto voxels = *scan_->voxels;
    voxels[voxel_] = {0.75f, 0.5625f, VoxelClass::occupied, true, 0};
    scan_->voxels = LaidOutVoxels(voxels);
    auto truth = *scan_->truth;
    touch_alone(truth, {4, 2, 3});
    truth.centre.set(voxel_, false);
    scan_->truth = std::make_shared<const GroundTruth>(truth);
    desk_.window.selection.voxel = voxel_;
    desk_.inspection.voxel = VoxelInspection{voxel_, {{2, 30, 0.85f, 1.25f, 0.777f}, {}}, {{}, {}}, {}, {}};
  }

  /// The surface touches this voxel and no other.
  static void touch_alone(GroundTruth& truth, const Eigen::Vector3i& cell) {
    truth.touch = BitMask(truth.touch.size());
    truth.touch.set(truth.grid.index(cell));
  }

  const std::uint32_t voxel_ = scan_->grid.index({1, 2, 3});
};

TEST_F(InspectedVoxel, ASmallOnesPlaceIsNotRoundedAway) {
  scan_->grid.first = Eigen::Vector3i(-4, 0, 6);
  scan_->grid.resolution = 0.0005;
  EXPECT_THAT(panel(), HasSubstr("centre -1.25, 1.25, 4.75 mm"));
}

TEST_F(InspectedVoxel, ItsNumbersAreItsOwnAndItsPlaceIsInMillimetres) {
  const Vector3 centre = scan_->grid.centre(voxel_);
  const std::string text = panel();
  EXPECT_THAT(text, HasSubstr("Voxel 1, 2, 3"));
  EXPECT_THAT(text, HasSubstr(fmt::format("centre {:.0f}, {:.0f}, {:.0f} mm", 1000 * centre.x(), 1000 * centre.y(),
                                          1000 * centre.z())));
  EXPECT_LT(centre.x(), -0.4) << "in metres it would be another number";
  EXPECT_THAT(text, HasSubstr("conventional p 0.750, occupied, 0.56 nats"));
  EXPECT_THAT(text, HasSubstr("truth free, 3 voxels from the surface"));
  EXPECT_THAT(text, HasSubstr("There is no Gibbs map yet."));
}

TEST_F(InspectedVoxel, ItsHistoryHasTheViewsThatMeasuredIt) {
  EXPECT_THAT(panel(), HasSubstr("view hits misses log-odds (change) 1 2 30 1.25 (+0.85) "));
  EXPECT_EQ(text_of(click_on(desk_, "1.25 (+0.85)")), "select-taken 1; panel view");
}

TEST_F(InspectedVoxel, TheTruthIsSaidInWords) {
  const auto expect_truth = [&](auto change, const char* words) {
    auto truth = *scan_->truth;
    change(truth);
    scan_->truth = std::make_shared<const GroundTruth>(truth);
    EXPECT_THAT(panel(), HasSubstr(words));
  };
  expect_truth([&](GroundTruth& t) { touch_alone(t, {2, 3, 4}); }, "free, 1 voxel from the surface");
  expect_truth([&](GroundTruth& t) { t.touch = BitMask(t.touch.size()); }, "free, far from the surface");
  expect_truth([&](GroundTruth& t) { t.centre.set(voxel_); }, "inside the object, out of sight");
  expect_truth([&](GroundTruth& t) { t.touch.set(voxel_); }, "the surface touches it");
}

TEST_F(InspectedVoxel, ItsGibbsMapAndItsFullConditionalAddUp) {
  GibbsMap gibbs;
  gibbs.views = 1;
  std::vector<Voxel> voxels = *scan_->voxels;
  voxels[voxel_] = {0.25f, 0.4375f, VoxelClass::unknown, true, 0};
  GibbsPosterior posterior;
  posterior.occupied.assign(voxels.size(), 0.125f);
  gibbs.posterior = std::make_shared<const GibbsPosterior>(posterior);
  gibbs.voxels = LaidOutVoxels(voxels);
  scan_->gibbs = std::make_shared<const GibbsMap>(gibbs);
  FullConditional f;
  f.probability = {0.875, 0.125};
  f.log_prior_odds = -2;
  f.rays = {{0, 0, 0, 0.75}, {1, 0, 0, -1.5}, {2, 0, 0, 0.5}};
  desk_.inspection.voxel->conditional = f;
  std::string text = panel();
  EXPECT_THAT(text, HasSubstr("Gibbs p 0.250, unknown, 0.44 nats"));
  EXPECT_THAT(text, HasSubstr("The Gibbs map is of the first view."));
  EXPECT_THAT(text, HasSubstr("Its p is that the surface touches it")) << "0.25 is no level's";
  EXPECT_THAT(text, HasSubstr("3 rays have a say free 0.8750 occupied 0.1250 log odds of occupied against free: -2.25, "
                              "of these prior -2.00, rays for it +1.25, against it -1.50"));
  f.probability = {0.5, 0.25, 0.25};
  desk_.inspection.voxel->conditional = f;
  text = panel();
  EXPECT_THAT(text, HasSubstr("free 0.5000 level 1 0.2500 level 2 0.2500 log odds of level 1 against free"));
  voxels[voxel_].measured = false;
  gibbs.voxels = LaidOutVoxels(voxels);
  scan_->gibbs = std::make_shared<const GibbsMap>(gibbs);
  EXPECT_THAT(panel(), HasSubstr("Gibbs not informed"));
}

/// A strip a chain, from the first sweep at the left to the last at the right.
TEST_F(InspectedVoxel, ItsTraceIsMarkedWhereItWasNotFree) {
  GibbsMap gibbs;
  gibbs.views = 2;
  gibbs.posterior = std::make_shared<const GibbsPosterior>();
  gibbs.voxels = LaidOutVoxels(*scan_->voxels);
  gibbs.config.model.kind = ForwardModel::attenuation;
  gibbs.config.model.attenuations = {1, 2};
  ASSERT_EQ(gibbs.config.model.levels(), 3);
  scan_->gibbs = std::make_shared<const GibbsMap>(gibbs);
  desk_.inspection.voxel->trace = {{0, 2, 0, 0, 2}, {0, 0}, {1, 2}};
  EXPECT_THAT(panel(), HasSubstr("its level after each sweep, a strip a chain"));
  std::vector<ImRect> strips;
  for (const ImRect& area : seen_areas(theme::sky, "Inspector"))
    if (area.GetHeight() < 14) strips.push_back(area);
  ASSERT_EQ(strips.size(), 3u);
  const auto expect_marks = [&](double depth, const std::vector<std::array<double, 3>>& expected) {
    const auto marks = seen_areas(mix(theme::sky, theme::occupied, depth), "Inspector");
    ASSERT_EQ(marks.size(), expected.size());
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const auto& [strip, from, to] = expected[i];
      const ImRect& place = strips[std::size_t(strip)];
      EXPECT_NEAR(marks[i].Min.x, place.Min.x + from * place.GetWidth(), 0.5);
      EXPECT_NEAR(marks[i].Max.x, place.Min.x + to * place.GetWidth(), 0.5);
      EXPECT_EQ(marks[i].Min.y, place.Min.y);
      EXPECT_EQ(marks[i].Max.y, place.Max.y);
    }
  };
  expect_marks(1.0, {{0, 0.2, 0.4}, {0, 0.8, 1.0}, {2, 0.5, 1.0}});
  expect_marks(0.7, {{2, 0.0, 0.5}});  // the lower level is paler
}

TEST_F(InspectedVoxel, AnotherVoxelsAnswerIsNotShown) {
  desk_.window.selection.voxel = voxel_ + 1;
  EXPECT_THAT(panel(), HasSubstr("Looking …"));
  EXPECT_THAT(panel(), Not(HasSubstr("Voxel")));
}

}  // namespace
}  // namespace nextview
