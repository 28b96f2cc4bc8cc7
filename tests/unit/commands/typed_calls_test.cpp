// Calls that are made of typed values, as panels make them: what they do, and how a script has them.
#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "tests/unit/workbench/small_scan.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/gibbs_commands.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

TEST(TypedCalls, AScriptHasThemAsItsReaderWants) {
  const std::vector<std::pair<CommandCall, std::string>> calls = {
      {command::step(), "step"},
      {command::speed(0.1), "speed 0.1"},
      {command::speed(2.0), "speed 2"},
      {command::select_view(17u), "select-view 17"},
      {command::take_view(), "take-view"},
      {command::take_view(3u), "take-view 3"},
      {command::refine(), "refine"},
      {command::refine(3), "refine 3"},
      {command::refine(3, 40), "refine 3 40"},
      {command::custom_view(), "custom-view"},
      {command::custom_view(0.6, -0.6, 0.5, 0.0, 0.0, 0.0), "custom-view 0.6 -0.6 0.5 0 0 0"},
      {command::voxel_map(MapChoice::gibbs), "voxel-map gibbs"},
      {command::slice_axis(SliceAxis::y), "slice-axis y"},
      {command::slice_at(-0.05), "slice-at -0.05"},
      {command::slice_at(0.0, 0.25), "slice-at 0 0.25"},
      {command::panel(panel_name::gibbs), "panel gibbs"},
      {command::curves(CurveKind::time, CurveKind::gain), "curves time gain"},
      {command::sort(CandidateColumn::cost, SortOrder::descending), "sort cost descending"},
      {command::open("a file.ply"), "open \"a file.ply\""},
      {command::set("planner.combined_weights", ""), "set planner.combined_weights \"\""},
      {command::palette("set "), "palette \"set \""}};
  for (const auto& [call, text] : calls) {
    EXPECT_EQ(call.text(), text);
    EXPECT_EQ(parse_call(text).command, call.command);
    EXPECT_EQ(parse_call(text).values(), call.values());
  }
}

/// A snapshot of a session that has an object, and what commands act on.
class TypedCallsOnAWindow : public testing::Test {
 protected:
  TypedCallsOnAWindow() { snapshot_.session = 1; }
  std::string error_of(const CommandCall& call) {
    CommandTarget target{worker_, window_, snapshot_, progress_};
    try {
      execute(call, target);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  SessionWorker worker_;
  WindowState window_;
  SessionSnapshot snapshot_;
  WorkerProgress progress_;
};

TEST_F(TypedCallsOnAWindow, DoWhatTheySay) {
  EXPECT_EQ(error_of(command::threshold(1.0 / 3)), "");
  EXPECT_EQ(window_.layers.voxels.unknown_from, 1.0 / 3) << "no digit is lost";
  EXPECT_EQ(error_of(command::voxel_colour(VoxelColouring::by_error)), "");
  EXPECT_EQ(window_.layers.colouring, VoxelColouring::by_error);
  EXPECT_EQ(error_of(command::sort(CandidateColumn::gain, SortOrder::ascending)), "");
  EXPECT_EQ(window_.sort_column, CandidateColumn::gain);
  EXPECT_TRUE(window_.sort_ascending);
  EXPECT_EQ(error_of(command::toggle_missed()), "");
  EXPECT_TRUE(window_.layers.missed);
}

TEST_F(TypedCallsOnAWindow, WhatIsOutOfRangeIsRefusedAsInAScript) {
  EXPECT_EQ(error_of(command::threshold(1.5)), "threshold: PROBABILITY must be a number from 0 to 1, not '1.5'");
  EXPECT_NE(error_of(command::threshold(std::numeric_limits<double>::quiet_NaN())), "");
  EXPECT_EQ(window_.layers.voxels.unknown_from, WindowState().layers.voxels.unknown_from);
  EXPECT_EQ(error_of(command::open("")), "open: FILE must be given, not ''");
  snapshot_.records.resize(1);
  EXPECT_EQ(error_of(command::refine(65, 20)), "refine: CHAINS must be a whole number from 1 to 64, not '65'");
}

TEST_F(TypedCallsOnAWindow, ALengthThatIsNoneIsAskedForWithAUnit) {
  EXPECT_EQ(error_of(command::set("map.resolution", "abc")),
            "Voxel (map.resolution) takes a length with its unit, such as 5 mm, not 'abc'");
  EXPECT_THAT(error_of(command::set("map.resolution", "0,5 mm")), testing::HasSubstr("did you mean '0.5 mm'?"));
}

TEST_F(TypedCallsOnAWindow, SettingsAreCalledAsThePanelCallsThem) {
  EXPECT_EQ(error_of(command::set("termination.views", "1e9")),
            "Views (termination.views) takes a whole number, not '1e9'");
  EXPECT_EQ(error_of(command::set("seed", "-5")), "Seed takes a whole number, 0 or more, not '-5'") << "said once";
}

TEST(Set, GivesOneSettingAndNoOther) {
  SessionWorker worker;
  WindowState window;
  const auto wait = [&] {
    while (worker.progress().busy) std::this_thread::yield();
  };
  worker.post(request::Load{small_scan()});
  wait();
  Configuration wanted = small_scan();
  wanted.seed = 99;
  wanted.map.resolution = 0.1 + 0.2 - 0.25;
  wanted.planner.gain = "random";
  wanted.evaluation.enabled = !wanted.evaluation.enabled;
  wanted.termination.views = 7;
  wanted.planner.combined_weights = "2";
  Configuration expected = small_scan();
  const auto set = [&](const std::string& key) {
    const auto snapshot = worker.snapshot();
    const WorkerProgress progress = worker.progress();
    CommandTarget target{worker, window, *snapshot, progress};
    auto all = settings(wanted);
    execute(command::set(key, find_setting(all, key).text()), target);
    wait();
    EXPECT_EQ(to_toml(worker.snapshot()->configuration), to_toml(expected)) << key;
  };
  expected.seed = wanted.seed;
  set("seed");
  expected.map.resolution = wanted.map.resolution;
  set("map.resolution");
  expected.planner.gain = wanted.planner.gain;
  set("planner.gain");
  expected.evaluation.enabled = wanted.evaluation.enabled;
  set("evaluation.enabled");
  expected.termination.views = wanted.termination.views;
  set("termination.views");
}

}  // namespace
}  // namespace nextview
