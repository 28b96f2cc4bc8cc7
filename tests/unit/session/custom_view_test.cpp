// Custom views: the operator's own, which are no candidates.
#include <gtest/gtest.h>

#include "core/export/scan_files.hpp"
#include "core/offline/refinement.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

Pose custom_view() { return look_at(Vector3(0.31, -0.62, 0.47), Vector3(0.02, 0.01, -0.03)); }

TEST(CustomView, IsTakenAndRecorded) {
  Session session(small_scan());
  session.step();
  EXPECT_FALSE(session.next_view_is_custom());
  const ScoreExplanation expected = session.explain(custom_view()).value();
  session.override_next_view(custom_view());
  EXPECT_TRUE(session.next_view_is_custom());
  EXPECT_FALSE(session.next_candidate());
  EXPECT_TRUE(session.next_view().isApprox(custom_view(), 1e-12));
  session.step();
  const StepRecord r = session.records()[1];
  EXPECT_EQ(r.view, -1);
  EXPECT_TRUE(r.overridden);
  EXPECT_GT(r.gain, 0.0);
  EXPECT_NEAR(r.gain, expected.value, 1e-9 * expected.value);
  EXPECT_EQ(r.utility, 0.0);
  EXPECT_TRUE(r.T_world_camera.isApprox(custom_view(), 1e-12));
  EXPECT_EQ(session.scans()[1]->origin, custom_view().translation());
  EXPECT_GT(r.points, 100u);
  for (const Candidate& c : r.candidates) EXPECT_TRUE(c.available) << "no candidate was taken";
  EXPECT_FALSE(session.next_view_is_custom());
  session.step();
  EXPECT_FALSE(session.records()[2].overridden);
  EXPECT_EQ(session.records()[2].view, int(r.ranking.best.value()));
}

TEST(CustomView, ThatIsACandidatesPoseIsScoredAsThatCandidate) {
  Configuration c = small_scan();
  c.planner.ray_refinement = 1;
  Session session(c);
  session.step();
  for (const std::size_t v : {0u, 5u}) {
    EXPECT_EQ(session.explain(session.candidates()[v])->value, session.explain(v)->value);
    EXPECT_NEAR(session.explain(v)->value, session.records()[0].candidates[v].gain, 1e-9);
  }
}

TEST(CustomView, ACandidateMayTakeItsPlaceAgain) {
  Session session(small_scan());
  session.step();
  const std::size_t proposal = session.next_candidate().value();
  session.override_next_view(custom_view());
  session.override_next_view(proposal);
  EXPECT_FALSE(session.next_view_is_custom());
  session.step();
  EXPECT_EQ(session.records()[1].view, int(proposal));
  EXPECT_FALSE(session.records()[1].overridden);
}

TEST(CustomView, StaysTheNextOneWhenTakingItIsCancelled) {
  Session session(small_scan());
  session.step();
  session.override_next_view(custom_view());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(session.step({}, stop.get_token()));
  EXPECT_TRUE(session.next_view_is_custom());
  EXPECT_TRUE(session.step());
  EXPECT_EQ(session.records()[1].view, -1);
}

TEST(CustomView, BadOnesAreRefusedAndChangeNothing) {
  Session session(small_scan()), untouched(small_scan());
  EXPECT_THROW(session.override_next_view(custom_view()), std::invalid_argument) << "before the first step";
  session.step();
  untouched.step();
  Pose nan = custom_view(), infinite = custom_view(), scaled = custom_view(), mirrored = custom_view(),
       sheared = custom_view();
  nan.translation().y() = std::nan("");
  infinite.translation().x() = INFINITY;
  scaled.linear() *= 1.01;
  mirrored.linear().col(0) *= -1.0;
  sheared.linear().col(0) += 0.01 * sheared.linear().col(1);
  for (const Pose& bad : {nan, infinite, scaled, mirrored, sheared})
    EXPECT_THROW(session.override_next_view(bad), std::invalid_argument);
  EXPECT_FALSE(session.next_view_is_custom());
  session.step();
  untouched.step();
  EXPECT_TRUE(same_scan(session, untouched));
}

TEST(CustomView, GainsThatAreNotOfSingleViewsExpectNothing) {
  for (const char* gain : {"random", "combined"}) {
    Configuration c = small_scan();
    c.planner.gain = gain;
    Session session(c);
    session.step();
    EXPECT_FALSE(session.explain(custom_view()));
    session.override_next_view(custom_view());
    session.step();
    EXPECT_EQ(session.records()[1].gain, 0.0);
    EXPECT_EQ(session.records()[1].view, -1);
  }
}

using CustomViewFiles = InTemporaryFolder;
TEST_F(CustomViewFiles, AreTakenAgainExactly) {
  Session session(small_scan());
  session.step();
  session.override_next_view(custom_view());
  session.step();
  session.step();
  session.override_next_view(look_at(Vector3(-0.5, 0.4, -0.6), Vector3(0.05, 0, 0)));
  session.step();
  OutputFolder out = begun(folder_);
  write_scan(session, out);
  const RefinementJob job = refinement_job(folder_, {});
  ASSERT_EQ(job.scans.size(), 4u);
  OccupancyMap map(job.grid, job.model);
  for (std::size_t k = 0; k < job.scans.size(); ++k) {
    EXPECT_EQ(job.scans[k].origin, session.scans()[k]->origin) << k;
    ASSERT_EQ(job.scans[k].hits.size(), session.scans()[k]->hits.size()) << k;
    for (std::size_t i = 0; i < job.scans[k].hits.size(); ++i)
      ASSERT_TRUE(job.scans[k].hits[i].isApprox(session.scans()[k]->hits[i], 1e-5f)) << k;
    map.insert(job.scans[k]);
    map.mark_occlusions(job.scans[k], 0.3);  // as the default gain wants
  }
  EXPECT_TRUE(same_map(map, session.map()));
}

}  // namespace
}  // namespace nextview
