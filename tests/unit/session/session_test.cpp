#include "core/session/session.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>
#include <set>

#include "core/evaluation/entropy.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

TEST(Session, RunsAlgorithm2ToItsTermination) {
  Session session(small_scan());
  EXPECT_TRUE(session.finished().empty());
  EXPECT_FALSE(session.next_candidate());
  finish(session);
  ASSERT_EQ(session.records().size(), 4u);
  EXPECT_EQ(session.scans().size(), 4u);
  EXPECT_NE(session.finished().find("4"), std::string::npos) << session.finished();
  EXPECT_THROW(session.step(), std::logic_error);
  std::set<int> views;
  for (std::size_t i = 0; i < 4; ++i) {
    const StepRecord& r = session.records()[i];
    EXPECT_EQ(r.step, int(i) + 1);
    EXPECT_TRUE(views.insert(r.view).second) << "view " << r.view << " came twice";
    ASSERT_EQ(r.candidates.size(), 10u);
    if (i == 0) continue;
    const StepRecord& before = session.records()[i - 1];
    ASSERT_EQ(r.view, int(before.ranking.best.value()));
    EXPECT_EQ(r.T_world_camera.matrix(), session.candidates()[r.view].matrix());
    EXPECT_EQ(r.gain, before.candidates[r.view].gain);
    EXPECT_EQ(r.utility, before.candidates[r.view].utility);
    const Vector3 way = r.T_world_camera.translation() - before.T_world_camera.translation();
    EXPECT_NEAR(r.motion.distance, way.norm(), 1e-12);
    EXPECT_FALSE(r.overridden);
    for (int v = 0; v < 10; ++v)  // taken candidates leave the list
      EXPECT_EQ(r.candidates[v].available, !views.contains(v)) << "step " << r.step << " view " << v;
    EXPECT_GE(r.coverage, before.coverage);
    EXPECT_LE(r.entropy, before.entropy);
  }
  EXPECT_EQ(session.records()[0].view, -1);
  EXPECT_EQ(session.records()[0].gain, 0.0);
  EXPECT_GT(session.records()[3].coverage, session.records()[0].coverage);
  EXPECT_EQ(session.next_candidate(), session.records()[3].ranking.best);
}

TEST(Session, RecordsAgreeWithTheMap) {
  Session session(small_scan());
  std::size_t measured_before = 0;
  double entropy_before = double(session.map().voxels().size()) * std::numbers::ln2;  // [nats]
  VoxelBricks before = session.planning_voxels();
  while (session.finished().empty()) {
    session.step();
    const StepRecord& r = session.records().back();
    std::size_t measured = 0;
    double entropy = 0.0;
    for (const Voxel& v : session.map().voxels()) measured += v.measured, entropy += v.entropy;
    EXPECT_EQ(r.new_voxels, measured - measured_before);
    EXPECT_EQ(r.entropy, double(session.map().voxels().size() - measured));  // Eq. 18: a bit a voxel
    EXPECT_NEAR(r.total_entropy * std::numbers::ln2, entropy, 1e-6 * entropy);
    EXPECT_NEAR(r.realised_gain, entropy_before - entropy, 1e-6 * entropy_before);  // Eq. 12
    EXPECT_EQ(r.realised_gain, map_change(before, session.planning_voxels()).realised_gain);
    EXPECT_EQ(r.points, session.scans().back()->hits.size());
    EXPECT_LE(r.points, r.hits);
    EXPECT_GT(r.points, 100u);
    EXPECT_LE(r.hits + r.misses, 80u * 60u);
    EXPECT_GT(r.seconds.sense + r.seconds.insert, 0.0);
    measured_before = measured, entropy_before = entropy;
    before = session.planning_voxels();
  }
}

TEST(Session, TheStartViewIsWhereItIsSaidToBe) {
  Configuration c = small_scan();
  c.planner.start_azimuth = 120, c.planner.start_elevation = -35, c.views.radius = 0.8;
  const Session session(c);
  const double a = 120 * std::numbers::pi / 180, e = -35 * std::numbers::pi / 180;
  const Vector3 expected = 0.8 * Vector3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  EXPECT_LT((session.next_view().translation() - expected).norm(), 1e-9);
  EXPECT_LT((session.next_view().linear().col(2) + expected.normalized()).norm(), 1e-9);
}

TEST(Session, TheSameBytesOnOneThreadAndTwo) {
  Configuration c = small_scan();
  c.sensor.dropout = 0.05;
  c.planner.gain = "proximity-count";
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    auto session = std::make_unique<Session>(c);
    finish(*session);
    return session;
  };
  const auto one = run(1), two = run(2);
  EXPECT_TRUE(same_scan(*one, *two));
  c.seed = 2;
  const auto other = run(2);
  EXPECT_FALSE(same_scan(*one, *other));
  EXPECT_NE(one->scans()[0]->hits, other->scans()[0]->hits);
}

TEST(Session, LocalOctreesAndDirectInsertionGiveTheSameScan) {
  Configuration local = small_scan(), direct = small_scan();
  local.map.insertion = Insertion::local_octree;
  Session a(local), b(direct);
  finish(a);
  finish(b);
  EXPECT_TRUE(same_scan(a, b));
}

TEST(Session, CancellingBeforeTheMeasurementChangesNothing) {
  Session untouched(small_scan()), session(small_scan());
  std::stop_source stop;
  stop.request_stop();
  for (int step = 0; step < 4; ++step) {
    EXPECT_FALSE(session.step({}, stop.get_token()));
    EXPECT_TRUE(same_scan(session, untouched)) << step;
    EXPECT_TRUE(session.step());
    EXPECT_TRUE(untouched.step());
  }
  EXPECT_TRUE(same_scan(session, untouched));
}

// A stop at any moment either changes nothing or leaves a whole step.
TEST(Session, CancellingAtAnyMomentLeavesNoHalfStep) {
  Session before(small_scan()), after(small_scan());
  before.step();
  after.step();
  int moments = 0, taken = 0, refused = 0;
  after.step([&](double, std::string_view) { ++moments; });
  for (int moment = 0; moment < moments; ++moment) {
    Session session(small_scan());
    session.step();
    std::stop_source stop;
    int calls = 0;
    const Progress stop_there = [&](double, std::string_view) {
      if (calls++ == moment) stop.request_stop();
    };
    const bool done = session.step(stop_there, stop.get_token());
    EXPECT_TRUE(same_scan(session, done ? after : before)) << "stopped at progress call " << moment;
    (done ? taken : refused) += 1;
  }
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0);
}

TEST(Session, ProgressRunsFromZeroToOne) {
  Session session(small_scan());
  std::vector<double> fractions;
  session.step([&](double fraction, std::string_view what) {
    EXPECT_FALSE(what.empty());
    fractions.push_back(fraction);
  });
  ASSERT_GE(fractions.size(), 2u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(Session, AnOperatorMayChooseAnotherView) {
  Session session(small_scan());
  session.step();
  const std::size_t proposal = session.next_candidate().value(), other = (proposal + 3) % 10;
  session.override_next_view(other);
  EXPECT_EQ(session.next_candidate(), other);
  EXPECT_EQ(session.next_view().matrix(), session.candidates()[other].matrix());
  session.step();
  EXPECT_EQ(session.records()[1].view, int(other));
  EXPECT_TRUE(session.records()[1].overridden);
  EXPECT_EQ(session.records()[1].gain, session.records()[0].candidates[other].gain);
  EXPECT_THROW(session.override_next_view(other), std::invalid_argument);  // taken
  EXPECT_THROW(session.override_next_view(10), std::invalid_argument);
  session.step();
  EXPECT_FALSE(session.records()[2].overridden);
}

TEST(Session, GoingBackToTheProposalIsNoOverride) {
  Session session(small_scan());
  session.step();
  const std::size_t proposal = session.next_candidate().value();
  session.override_next_view((proposal + 1) % 10);
  session.override_next_view(proposal);
  session.step();
  EXPECT_EQ(session.records()[1].view, int(proposal));
  EXPECT_FALSE(session.records()[1].overridden);
}

TEST(Session, EndsWhenNoCandidateIsLeft) {
  Configuration c = small_scan();
  c.views.count = 2;
  c.termination.views = 20;
  Session session(c);
  finish(session);
  EXPECT_EQ(session.records().size(), 3u);  // the start view and both candidates
  EXPECT_NE(session.finished().find("no candidate"), std::string::npos) << session.finished();
}

TEST(Session, EndsAtTheCoverageAskedFor) {
  Configuration c = small_scan();
  c.views.count = 20;
  c.termination.views = 20;
  c.termination.coverage = 0.5;
  Session session(c);
  finish(session);
  const auto& records = session.records();
  ASSERT_GE(records.size(), 2u);
  EXPECT_LT(records.size(), 20u);
  EXPECT_GE(records.back().coverage_visible, 0.5);
  for (std::size_t i = 0; i + 1 < records.size(); ++i) EXPECT_LT(records[i].coverage_visible, 0.5);
}

}  // namespace
}  // namespace nextview
