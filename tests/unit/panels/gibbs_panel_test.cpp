// What the Gibbs panel asks for and what it says of the chains and of the map.
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;

class GibbsPanelTest : public testing::Test {
 protected:
  GibbsPanelTest() {
    desk_.snapshot = scan_;
    desk_.window.bring_to_front(panel_name::gibbs);
  }

  static GibbsMap made_map() {
    GibbsMap map;
    map.views = 2;
    map.posterior = std::make_shared<const GibbsPosterior>(made_posterior());
    map.change.changed_class = 2000;
    map.change.entropy_before = 9000;
    map.change.entropy_after = 4000;
    map.change.before[19] = 99;
    map.change.after[19] = 9;
    return map;
  }
  static GibbsPosterior made_posterior() {
    GibbsPosterior posterior;
    SamplerDiagnostics& d = posterior.diagnostics;
    d.stationary = true;
    d.sweeps = 12;
    d.r_hat = 1.0125;
    d.trend = 1.75;
    d.disagreeing_voxels = 7;
    d.informed_voxels = 5000;
    d.effective_samples = 222;
    d.merged_rays = 400;
    d.measured_rays = 1000;
    d.build_seconds = 0.5;
    d.sample_seconds = 2;
    d.log_posterior = {{-9000, -3000, -2000}, {-8000, -4000, -1000}};
    return posterior;
  }
  std::string panel(const GibbsMap& map) {
    scan_->gibbs = std::make_shared<const GibbsMap>(map);
    desk_.frames();
    return read("Gibbs");
  }
  /// The n-th button of this label, from the uppermost.
  void press(const std::string& label, std::size_t n) {
    std::vector<SeenText> found;
    for (const SeenText& t : seen_texts())
      if (t.window == "Gibbs" && t.text == label) found.push_back(t);
    ASSERT_GT(found.size(), n) << read("Gibbs");
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.from.y < b.from.y; });
    desk_.click((found[n].from.x + found[n].to.x) / 2, found[n].middle());
    EXPECT_TRUE(desk_.frames().empty());
  }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_;
};

TEST_F(GibbsPanelTest, RefinesWithTheChainsAndSweepsThatItShows) {
  scan_->configuration.gibbs.sampler.chains = 2;
  scan_->configuration.gibbs.sampler.sweeps = 300;
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Refine the map", "Gibbs")), "refine 2 300");
  press("+", 0);
  EXPECT_EQ(text_of(click_on(desk_, "Refine the map", "Gibbs")), "refine 3 300");
  press("+", 1);
  press("+", 1);
  EXPECT_EQ(text_of(click_on(desk_, "Refine the map", "Gibbs")), "refine 3 302");
  press("-", 0);
  press("-", 0);
  press("-", 0);
  EXPECT_EQ(text_of(click_on(desk_, "Refine the map", "Gibbs")), "refine 1 302") << "a chain there must be";
}

TEST_F(GibbsPanelTest, EachDiagnosticStandsAtItsName) {
  const std::string text = panel(made_map());
  EXPECT_THAT(text, HasSubstr("Stationary after 12 sweeps of 2 chains."));
  EXPECT_THAT(text, HasSubstr("R-hat 1.012 (under 1.05) trend |z| 1.8 (under 2.58) effective samples 222 "
                              "voxels in dispute 7 of 5000 merged rays 400 of 1000 time 2.5 s"));
  EXPECT_THAT(text, Not(HasSubstr("refine again")));
}

TEST_F(GibbsPanelTest, NoDigitIsCutOffOfMillions) {
  GibbsMap map = made_map();
  GibbsPosterior posterior = made_posterior();
  posterior.diagnostics.merged_rays = posterior.diagnostics.disagreeing_voxels = 1234567;
  posterior.diagnostics.measured_rays = posterior.diagnostics.informed_voxels = 12345678;
  map.posterior = std::make_shared<const GibbsPosterior>(posterior);
  EXPECT_THAT(panel(map), HasSubstr("merged rays 1234567 of 12345678"));
  for (const SeenText& cut : cut_texts()) ADD_FAILURE() << cut.text;
}

TEST_F(GibbsPanelTest, ChainsThatAreNotStationarySaySoInRed) {
  GibbsMap map = made_map();
  GibbsPosterior posterior = made_posterior();
  posterior.diagnostics.stationary = false;
  posterior.diagnostics.warning = "not stationary after 12 sweeps";
  map.posterior = std::make_shared<const GibbsPosterior>(posterior);
  const std::string text = panel(map);
  EXPECT_THAT(text, HasSubstr("not stationary after 12 sweeps"));
  EXPECT_THAT(text, Not(HasSubstr("Stationary after")));
  const auto all = seen_texts();
  EXPECT_EQ(find_text(all, "not stationary")->colour, to_imgui_u32(theme::chosen));
  panel(made_map());
  const auto good = seen_texts();
  EXPECT_EQ(find_text(good, "Stationary after")->colour, to_imgui_u32(theme::series[2]));
}

TEST_F(GibbsPanelTest, OfTooFewSweepsItSaysWhatToDoAndNoNumbers) {
  GibbsMap map = made_map();
  GibbsPosterior posterior = made_posterior();
  posterior.diagnostics.stationary = false;
  posterior.diagnostics.sweeps = 5;
  posterior.diagnostics.warning = "5 sweeps are too few to tell";
  map.posterior = std::make_shared<const GibbsPosterior>(posterior);
  const std::string text = panel(map);
  EXPECT_THAT(text, HasSubstr("5 sweeps are too few to tell. Refine the map"));
  EXPECT_THAT(text, Not(HasSubstr("R-hat")));
  EXPECT_THAT(text, HasSubstr("voxels in dispute 7 of 5000"));
  posterior.diagnostics.stopped = true;
  posterior.diagnostics.warning = "stopped after 5 sweeps";
  map.posterior = std::make_shared<const GibbsPosterior>(posterior);
  EXPECT_THAT(panel(map), AllOf(HasSubstr("stopped after 5 sweeps"), Not(HasSubstr("to know"))));
  posterior.diagnostics.stopped = false;
  posterior.diagnostics.merged_rays = 0;
  posterior.diagnostics.warning = "no ray enters the region";
  map.posterior = std::make_shared<const GibbsPosterior>(posterior);
  EXPECT_THAT(panel(map), AllOf(HasSubstr("no ray enters the region"), Not(HasSubstr("to know"))));
  EXPECT_EQ(find_text(seen_texts(), "no ray enters")->colour, to_imgui_u32(theme::chosen));
}

TEST_F(GibbsPanelTest, SaysWhatRefiningChangedAndOfWhichViewsItIs) {
  EXPECT_THAT(panel(made_map()), HasSubstr("2 thousand voxels are of another class than in the conventional map; the "
                                           "total entropy went from 0.013 Mbit to 0.006 Mbit."));
  GibbsMap map = made_map();
  map.views = 1;
  EXPECT_THAT(panel(map), HasSubstr("This is the map of the first view: refine again."));
  scan_->gibbs = nullptr;
  desk_.frames();
  EXPECT_THAT(read("Gibbs"), HasSubstr("No Gibbs map yet."));
}

/// The values that the plots show at the pointer, which is at the right end of each.
TEST_F(GibbsPanelTest, ThePlotsHaveTheValuesOfTheChainsAndOfTheHistograms) {
  panel(made_map());
  const auto hover_below = [&](const char* title) {
    const auto all = seen_texts();
    const SeenText* text = find_text(all, title, "Gibbs");
    ASSERT_NE(text, nullptr) << read("Gibbs");
    desk_.move(text->from.x + 250, text->from.y + 80);
    desk_.frames();
  };
  hover_below("Voxels by p");
  EXPECT_EQ(read_tooltip(), "p 0.975 conventional: 2 Gibbs: 1") << "log10 of 1 + 99 and 1 + 9";
  scan_->gibbs = nullptr;
  desk_.progress.busy = desk_.progress.refining = true;
  desk_.progress.sampler = std::make_shared<const SamplerDiagnostics>(made_posterior().diagnostics);
  desk_.move(1, 1);
  desk_.frames();
  EXPECT_THAT(read("Gibbs"), HasSubstr("12 sweeps so far"));
  hover_below("Log-posterior");
  EXPECT_EQ(read_tooltip(), "sweep 3 chain 1: -1 knats chain 2: 0 knats");
}

TEST_F(GibbsPanelTest, PauseAndResumeAreOneButton) {
  desk_.progress.busy = desk_.progress.refining = true;
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Pause", "Gibbs")), "pause-refinement");
  desk_.progress.paused = true;
  desk_.frames();
  EXPECT_EQ(text_of(click_on(desk_, "Resume", "Gibbs")), "resume-refinement");
  EXPECT_EQ(text_of(click_on(desk_, "Refine the map", "Gibbs")), "") << "while it runs";
}

TEST_F(GibbsPanelTest, BeforeAfterAndDifferenceChooseWhatTheSceneShows) {
  panel(made_map());
  EXPECT_EQ(text_of(click_on(desk_, "after", "Gibbs")), "voxel-map gibbs");
  EXPECT_EQ(text_of(click_on(desk_, "before", "Gibbs")), "voxel-map conventional");
  EXPECT_EQ(text_of(click_on(desk_, "difference", "Gibbs")), "voxel-map gibbs; voxel-colour difference");
  desk_.window.layers.colouring = VoxelColouring::by_difference;
  EXPECT_EQ(text_of(click_on(desk_, "before", "Gibbs")), "voxel-map conventional; voxel-colour probability");
}

}  // namespace
}  // namespace nextview
