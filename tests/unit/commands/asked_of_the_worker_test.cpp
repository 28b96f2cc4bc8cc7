// What commands ask the worker for, with which numbers.
#include <gtest/gtest.h>

#include "tests/unit/commands/worker_commands.hpp"
#include "tests/unit/workbench/job_control.hpp"

namespace nextview {
namespace {

using Kind = ViewSelection::Kind;
using AskedOfTheWorker = WorkerCommands;

TEST_F(AskedOfTheWorker, RefineHasItsNumbersOrThoseOfTheSettings) {
  Configuration c = small_scan();
  c.gibbs.sampler.chains = 3;
  c.gibbs.sampler.sweeps = 9;
  load(c);
  step();
  for (const auto& [line, chains, sweeps] :
       {std::tuple{"refine", 3, 9}, {"refine 1", 1, 9}, {"refine 1 14", 1, 14}, {"refine 2 5", 2, 5}}) {
    run(line);
    EXPECT_EQ(now()->gibbs->config.chains, chains) << line;
    EXPECT_EQ(now()->gibbs->config.sweeps, sweeps) << line;
    EXPECT_EQ(window_.in_front(Side::right), panel_name::gibbs);
  }
}

TEST_F(AskedOfTheWorker, ViewsAreTakenAsAsked) {
  load();
  step();
  const std::size_t proposed = *now()->proposal(), other = proposed == 3 ? 4 : 3, third = proposed == 5 ? 6 : 5;
  window_.selection.view = {Kind::candidate, other};
  window_.selection.ray = 3;
  run("take-view");
  EXPECT_EQ(now()->next_candidate, other) << "the selected one";
  EXPECT_TRUE(window_.selection.view == ViewSelection{}) << "it is the next view now";
  EXPECT_FALSE(window_.selection.ray);
  run("take-proposal");
  EXPECT_EQ(now()->next_candidate, proposed);
  run("take-view " + std::to_string(third));
  EXPECT_EQ(now()->next_candidate, third);
  window_.selection.custom_view = custom_view();
  run("take-custom-view");
  EXPECT_TRUE(now()->custom_next_view);
  EXPECT_TRUE(now()->next_view.isApprox(custom_view()));
  run("step");
  EXPECT_EQ(now()->records.size(), 2u);
  EXPECT_THROW(run("take-view"), std::invalid_argument) << "nothing is selected";
  run("undo");
  EXPECT_EQ(now()->records.size(), 1u);
  run("redo");
  EXPECT_EQ(now()->records.size(), 2u);
  run("reset");
  EXPECT_EQ(now()->records.size(), 0u);
}

TEST_F(AskedOfTheWorker, SettingsAndSpeed) {
  load();
  run("set termination.views 7");
  EXPECT_EQ(now()->configuration.termination.views, 7);
  EXPECT_EQ(now()->configuration.views.count, 8) << "the others stay";
  run("reset-setting termination.views");
  EXPECT_EQ(now()->configuration.termination.views, Configuration().termination.views);
  EXPECT_EQ(now()->configuration.views.count, 8);
  run("speed 1.5");
  EXPECT_EQ(worker_.progress().pause_between_views, 1.5);
  run("open box");
  EXPECT_EQ(now()->object_name, "box");
  try {
    run("set map.resolution -1");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Voxel (map.resolution) must be from 0.01 mm to 1 m, not -1 m") << "label and key";
  }
  EXPECT_EQ(now()->object_name, "box");
}

}  // namespace
}  // namespace nextview
