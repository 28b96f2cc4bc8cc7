// The state of a scan is a value: it is kept, restored, forked, and made again from its scans.
#include <gtest/gtest.h>

#include <thread>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

Configuration planned_by(const std::string& gain) {
  Configuration c = small_scan();
  c.planner.gain = gain;
  if (gain == "gibbs") c.gibbs.view_sweeps = 4;
  return c;
}

bool same_state(const ScanState& a, const ScanState& b) {
  const auto same_record_pointed_to = [](const auto& x, const auto& y) { return same_record(*x, *y); };
  const bool same_posterior =
      !a.known.posterior == !b.known.posterior &&
      (!a.known.posterior || a.known.posterior->posterior().occupied == b.known.posterior->posterior().occupied);
  return same_map(a.known.map, b.known.map) && same_posterior &&
         std::ranges::equal(a.records, b.records, same_record_pointed_to) &&
         a.evaluation->visited_voxels == b.evaluation->visited_voxels && a.evaluation->seen == b.evaluation->seen &&
         std::ranges::equal(a.evaluation->coverage.observed(), b.evaluation->coverage.observed()) &&
         a.next.view == b.next.view && a.finished == b.finished && a.known.taken.size() == b.known.taken.size();
}

/// The states before each step and after the last.
std::vector<ScanState> states_of(Session& session) {
  std::vector<ScanState> states = {session.state()};
  while (session.finished().empty()) {
    session.step();
    states.push_back(session.state());
  }
  return states;
}

const std::vector<std::string> gains = {"proximity-count", "occlusion-aware", "gibbs", "oracle", "random"};

TEST(ScanState, GoingOnFromAnyStateIsAsTheFirstTime) {
  for (const std::string& gain : gains) {
    Session session(planned_by(gain));
    const std::vector<ScanState> states = states_of(session);
    for (std::size_t k = states.size(); k-- > 0;) {
      session.restore(states[k]);
      EXPECT_EQ(session.records().size(), k);
      finish(session);
      EXPECT_TRUE(same_state(session.state(), states.back())) << gain << " from " << k;
    }
  }
}

TEST(ScanState, AStepLeavesTheStateBeforeItAsItWas) {
  Session session(planned_by("gibbs")), other(planned_by("gibbs"));
  session.step();
  other.step();
  const ScanState kept = session.state();
  session.step();
  session.step();
  EXPECT_TRUE(same_state(kept, other.state()));
}

TEST(ScanState, IsMadeAgainFromItsScans) {
  for (const std::string& gain : gains) {
    Session session(planned_by(gain));
    const std::vector<ScanState> states = states_of(session);
    for (std::size_t from = 0; from < states.size(); ++from) {
      ScanState last = states.back();
      drop_maps(session.setup(), last);
      EXPECT_FALSE(last.has_maps);
      EXPECT_EQ(bytes_of(last), 0u);
      EXPECT_EQ(last.known.map.voxels().bytes(), 0u);
      remake(session.setup(), last, states[from], {}, {});
      EXPECT_TRUE(last.has_maps);
      EXPECT_TRUE(same_state(last, states.back())) << gain << " from " << from;
    }
  }
}

TEST(ScanState, AbsorbingIsAPureFunctionOnAnyThread) {
  Session session(planned_by("gibbs"));
  session.step();
  SimulatedSource source(
      std::make_shared<SimulatedWorld>(std::make_shared<PlacedMesh>(load_placed_mesh(session.object_file(), {0.5})),
                                       session.configuration().sensor),
      session.configuration().seed);
  FreeFlyingCamera robot(session.state().T_world_camera);
  const ScanState before = session.state();
  const Acquired acquired = std::get<Acquired>(acquire(before.next.view, 2, source, robot, {}, {}));
  std::vector<ScanState> forks(3);
  std::vector<std::thread> threads;
  for (ScanState& fork : forks) threads.emplace_back([&] { fork = absorb(session.setup(), before, acquired, {}, {}); });
  for (std::thread& thread : threads) thread.join();
  session.step();
  for (const ScanState& fork : forks) {
    EXPECT_TRUE(same_map(fork.known.map, session.map()));
    EXPECT_EQ(fork.known.posterior->posterior().occupied, session.refinement()->posterior().occupied);
  }
}

TEST(ScanState, AForkCopiesLittleAndAViewTakesLessThanHalfOfTheMap) {
  Configuration c = small_scan();
  c.map.resolution = 0.01;  // 128 voxels along each edge
  Session session(c);
  session.step();
  const ScanState fork = session.state();
  EXPECT_EQ(bytes_of(fork, &session.state()), 0u) << "it shares all";
  EXPECT_LE(sizeof(Knowledge), std::size_t{64} << 10);
  const std::size_t whole = OccupancyMap::bytes(session.map().grid());
  for (int view = 0; view < 3; ++view) {
    const ScanState before = session.state();
    session.step();
    const std::size_t bytes = bytes_of(session.state(), &before);
    RecordProperty("bytes_of_view_" + std::to_string(view + 2), std::to_string(bytes));
    EXPECT_LT(bytes, whole / 2) << view;
    EXPECT_GT(bytes, 0u);
  }
}

// What ranks the views is no part of what was scanned: after a change all is as with that planner from the start, but
// for the views that were taken.
TEST(ScanState, AnotherPlannerRanksTheSameScan) {
  Configuration c = small_scan();
  Session session(c);
  session.step();
  session.step();
  for (const char* gain : {"occlusion-aware", "rear-side-voxel", "proximity-count", "random"}) {
    c.planner.gain = gain;
    session.set_planner(c.planner);
    Session fresh(c);
    fresh.step();
    const Pose second = session.records()[1].T_world_camera;
    const auto& views = fresh.candidates();
    const auto same = std::ranges::find_if(views, [&](const Pose& p) { return p.matrix() == second.matrix(); });
    ASSERT_NE(same, views.end());
    fresh.override_next_view(std::size_t(same - views.begin()));
    fresh.step();
    EXPECT_TRUE(same_map(session.map(), fresh.map())) << gain;
    EXPECT_TRUE(same_candidates(session.records()[1].candidates, fresh.records()[1].candidates)) << gain;
    EXPECT_EQ(session.next_candidate(), fresh.next_candidate()) << gain;
  }
}

// Nor is which views are ranked; a planner that knows the truth knows what those see.
TEST(ScanState, OtherCandidatesRankTheSameScan) {
  Configuration c = small_scan();
  Session session(c);
  session.step();
  const Pose second = session.candidates()[*session.next_candidate()];
  session.override_next_view(second);
  session.step();
  const ScanState before = session.state();
  const PlanningConfig first = session.planning();
  for (const char* gain : {"new-surface", "oracle", "set-cover", "covering-order"}) {
    PlanningConfig other = first;
    other.planner.gain = gain;
    other.views.count = 17;
    other.views.layout = ViewLayout::fibonacci;
    session.set_planning(other);
    ASSERT_EQ(session.candidates().size(), 17u);
    EXPECT_EQ(session.records().back().coverage_visible, before.records.back()->coverage_visible);

    c.planner = other.planner;
    c.views = other.views;
    Session fresh(c);
    fresh.step();
    fresh.override_next_view(second);
    fresh.step();
    EXPECT_TRUE(same_map(session.map(), fresh.map())) << gain;
    // What was promised of the second view went by what the candidates of then left; it is a factor of all gains.
    const auto& ranked = session.records()[1].candidates;
    const auto& ranked_anew = fresh.records()[1].candidates;
    for (std::size_t v = 0; v < ranked.size(); ++v) {
      EXPECT_EQ(ranked[v].available, ranked_anew[v].available) << gain;
      EXPECT_EQ(ranked[v].cost, ranked_anew[v].cost) << gain;
      EXPECT_NEAR(ranked[v].utility, ranked_anew[v].utility, 1e-12) << gain;
      EXPECT_NEAR(ranked[v].gain, ranked_anew[v].gain, 0.05 * ranked_anew[v].gain) << gain;
    }
    EXPECT_EQ(session.next_candidate(), fresh.next_candidate()) << gain;
  }
  session.set_planning(first);
  EXPECT_TRUE(same_state(session.state(), before));
  PlanningConfig wrong = first;
  wrong.views.layout = ViewLayout::file;
  wrong.views.file = "none";
  EXPECT_THROW(session.set_planning(wrong), std::runtime_error);
  EXPECT_TRUE(same_state(session.state(), before));
}

}  // namespace
}  // namespace nextview
