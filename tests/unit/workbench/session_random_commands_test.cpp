// Commands at random on a session and its branches, against a model that recomputes everything.
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/workbench/kept_folder.hpp"
#include "tests/unit/workbench/session_runner_test.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What led to where a session stands, and nothing else: the model that recomputes everything.
struct Done {
  std::vector<std::size_t> candidates;    ///< that were taken instead of the proposal; npos: the proposal
  std::vector<PlanningConfig> plannings;  ///< by which each was chosen
  PlanningConfig planning;                ///< of now
};

constexpr std::size_t proposal = std::size_t(-1);

std::shared_ptr<const SessionSnapshot> recomputed(const Done& done, const Configuration& configuration) {
  SessionRunner runner;
  runner.load(configuration, job_control());
  for (std::size_t k = 0; k < done.candidates.size(); ++k) {
    runner.set_planning(done.plannings[k], job_control());
    if (done.candidates[k] != proposal) runner.take_view(done.candidates[k]);
    runner.step(job_control());
  }
  runner.set_planning(done.planning, job_control());
  return runner.snapshot();
}

class SessionRandomCommands : public SessionRunnerTest {};

/// NEXTVIEW_RANDOM_COMMANDS sets how many; a thousand were run (CHANGELOG).
TEST_F(SessionRandomCommands, EqualAModelThatRecomputesEverything) {
  const char* const wanted = std::getenv("NEXTVIEW_RANDOM_COMMANDS");
  const int commands = wanted ? std::atoi(wanted) : 60;
  std::mt19937 random(11);
  Configuration c = small_scan();
  c.termination.views = 50;
  c.evaluation.enabled = false;
  c.history.memory = 0.0005;
  const auto open = [&](const fs::path& folder) {
    auto runner = std::make_unique<SessionRunner>();
    runner->keep_sessions(folder_ / "state", [](const std::string& line) { ADD_FAILURE() << line; });
    folder.empty() ? runner->load(c, job_control()) : runner->open(folder, job_control());
    return runner;
  };
  auto runner = open({});
  runner->step(job_control());
  const fs::path folder = kept_folder(folder_ / "state");

  Done done{{proposal}, {planning_of(runner->configuration())}, planning_of(runner->configuration())};
  for (int k = 0; k < commands; ++k) {
    SCOPED_TRACE(k);
    const SessionSnapshot& s = *runner->snapshot();
    const std::size_t kind = random() % 9;
    if (kind < 3 && runner->can_step()) {
      std::size_t taken = proposal;
      if (random() % 3 == 0 && !s.records.empty())
        for (std::size_t v = random() % 8; taken == proposal && v < 8; ++v)
          if (s.available(v) && v != s.proposal()) runner->take_view(taken = v);
      done.candidates.push_back(taken);
      done.plannings.push_back(done.planning);
      runner->step(job_control());
    } else if (kind == 3 && s.timeline->at > 0) {
      const std::size_t views = random() % (done.candidates.size() + 1);
      runner->go_to("", views, job_control());
      if (views < done.candidates.size()) {
        done.candidates.resize(views);
        done.plannings.resize(views, done.planning);
        done.planning = planning_of(runner->configuration());
      }
    } else if (kind == 4) {
      done.planning = planning_of(runner->configuration());
      if (random() % 2)
        done.planning.planner.gain = random() % 2 ? "rear-side-voxel" : "proximity-count";
      else
        done.planning.views.count = 10 + int(random() % 3);
      runner->set_planning(done.planning, job_control());
    } else if (kind == 5) {
      runner->begin_branch("");
    } else if (kind == 6) {  // there and back again
      int far = 0;
      for (; far < 2 && runner->snapshot()->can_undo; ++far) runner->undo(job_control());
      for (; far > 0; --far) runner->redo(job_control());
    } else if (kind == 7) {
      const auto& all = s.timeline->branches.all;
      const std::string here = s.timeline->branches.current().name, there = all[random() % all.size()].name;
      const auto at = s.records.size();
      runner->go_to(there, {}, job_control());
      runner->go_to(here, at, job_control());
    } else if (kind == 8) {
      runner.reset();
      runner = open(folder);
    }
    if (done.candidates.empty()) continue;  // where nothing is ranked all planners show the same
    expect_same_scan(*runner->snapshot(), *recomputed(done, c));
    if (HasFailure()) return;
  }
  EXPECT_GT(runner->snapshot()->timeline->branches.all.size(), 3u);
}

}  // namespace
}  // namespace nextview
