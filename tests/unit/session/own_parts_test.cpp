// Sessions with parts of one's own, each in one file of tests/exercises and one line here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/source/recorded_source.hpp"
#include "tests/exercises/closer_candidates.hpp"
#include "tests/exercises/highest_first_policy.hpp"
#include "tests/exercises/plane_source.hpp"
#include "tests/exercises/shaky_robot.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

Pose start() { return look_at({0.6, 0.2, 0.6}, Vector3::Zero()); }

TEST(OwnParts, APolicyDecidesWhereToLook) {
  SessionParts parts;
  parts.planner = std::make_unique<OneStepPlanner>(std::make_unique<HighestFirstPolicy>());
  Session session(small_scan(), std::move(parts));
  EXPECT_EQ(session.planner().unit(), "m");
  double last = 2.0;
  for (int view = 0; view < 3; ++view) {
    session.step();
    double highest = -1.0;
    for (std::size_t v = 0; v < session.candidates().size(); ++v)
      if (session.records().back().candidates[v].available)
        highest = std::max(highest, session.candidates()[v].translation().z());
    EXPECT_EQ(session.next_view().translation().z(), highest);
    EXPECT_LE(highest, last);
    last = highest;
  }
}

TEST(OwnParts, ThePoseThatCountsIsTheOneThatWasReached) {
  SessionParts parts;
  parts.robot = std::make_unique<ShakyRobot>(start());
  Session session(small_scan(), std::move(parts));
  EXPECT_EQ(session.next_view().matrix(), start().matrix()) << "it begins where the robot is";
  for (int view = 0; view < 3; ++view) {
    const Pose wanted = session.next_view();
    const auto candidate = session.next_candidate();
    session.step();
    const StepRecord& record = session.records().back();
    EXPECT_TRUE((record.T_world_camera.translation() - wanted.translation()).isApprox(ShakyRobot::error, 1e-9));
    EXPECT_EQ(session.scans().back()->origin, record.T_world_camera.translation());
    EXPECT_EQ(session.state().known.taken.back().wanted.T_world_camera.matrix(), wanted.matrix());
    EXPECT_EQ(session.state().known.taken.back().T_world_camera.matrix(), record.T_world_camera.matrix());
    EXPECT_FALSE(candidate && record.candidates[*candidate].available) << "it was taken, if not quite";
    for (std::size_t v = 0; v < session.candidates().size(); ++v)
      EXPECT_FALSE(session.candidates()[v].translation().z() < -0.5 && record.candidates[v].available);
  }
}

TEST(OwnParts, ARobotIsAskedOnceForAllCandidates) {
  SessionParts parts;
  auto robot = std::make_unique<ShakyRobot>(start());
  const ShakyRobot& asked = *robot;
  parts.robot = std::move(robot);
  Session session(small_scan(), std::move(parts));
  session.step();
  EXPECT_EQ(asked.exchanges, 2) << "what the move costs, and where it could go from there";
}

TEST(OwnParts, WhatTheRobotCannotReachIsNotTaken) {
  SessionParts parts;
  parts.robot = std::make_unique<ShakyRobot>(start());
  Configuration c = small_scan();
  c.termination.views = 20;
  Session session(c, std::move(parts));
  session.step();
  std::size_t below = 0;
  for (std::size_t v = 0; v < session.candidates().size(); ++v) {
    const bool reachable = session.candidates()[v].translation().z() >= -0.5;
    EXPECT_EQ(session.records()[0].candidates[v].available, reachable) << v;
    if (reachable) continue;
    ++below;
    EXPECT_THROW(session.override_next_view(v), std::invalid_argument);
    try {
      session.override_next_view(session.candidates()[v]);
      ADD_FAILURE() << v;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("it is below the table"));
    }
  }
  ASSERT_GT(below, 0u);
  finish(session);
  EXPECT_EQ(session.records().size(), 1 + session.candidates().size() - below) << "all others";
}

TEST(OwnParts, AFailureOfTheRobotOrTheSourceLosesNothing) {
  SessionParts parts;
  auto robot = std::make_unique<ShakyRobot>(start());
  auto source = std::make_unique<PlaneSource>();
  ShakyRobot& arm = *robot;
  PlaneSource& camera = *source;
  parts.robot = std::move(robot);
  parts.source = std::move(source);
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  Session session(c, std::move(parts));
  EXPECT_EQ(session.mesh(), nullptr) << "there is no object to load";
  EXPECT_EQ(session.known_object(), nullptr);
  session.step();
  const OccupancyMap before = session.map();
  const Pose wanted = session.next_view();
  const auto reason_of_step = [&]() -> std::string {
    try {
      session.step();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it worked";
  };
  arm.jammed = true;
  EXPECT_EQ(reason_of_step(), "the arm is jammed");
  arm.jammed = false;
  camera.failing_step = 2;
  EXPECT_EQ(reason_of_step(), "the cable is out");
  EXPECT_TRUE(same_map(session.map(), before));
  EXPECT_EQ(session.records().size(), 1u);
  EXPECT_EQ(session.next_view().matrix(), wanted.matrix());
  EXPECT_TRUE((arm.pose().translation() - wanted.translation()).isApprox(ShakyRobot::error, 1e-9))
      << "a real robot stays where it got to";
  camera.failing_step = 0;
  EXPECT_EQ(reason_of_step(), "it worked");
  EXPECT_NEAR(session.records().back().motion.distance, ShakyRobot::error.norm(), 1e-9) << "and goes on from there";
  std::size_t above = 0;
  for (const Eigen::Vector3f& point : session.scans().back()->hits) above += std::abs(point.z()) > 1e-4f;
  EXPECT_EQ(above, 0u) << "all returns lie on the plane";
}

TEST(OwnParts, AnOperatorMayLookAtACaptureAndRefuseIt) {
  Session session(small_scan()), other(small_scan());
  session.step();
  other.step();
  const Pose wanted = session.next_view();
  std::size_t pixels = 0;
  const auto refuse = [&](const Acquired& acquired) {
    pixels = std::get<DepthImage>(acquired.capture.measured).range.size();
    EXPECT_EQ(acquired.wanted.T_world_camera.matrix(), wanted.matrix());
    return false;
  };
  EXPECT_FALSE(session.step({}, {}, refuse));
  EXPECT_EQ(pixels, 80u * 60u);
  EXPECT_TRUE(same_scan(session, other));
  EXPECT_TRUE(session.step({}, {}, [](const Acquired&) { return true; }));
  other.step();
  EXPECT_TRUE(same_scan(session, other));
}

TEST(OwnParts, CandidatesMayChangeFromViewToView) {
  SessionParts parts;
  parts.candidates = std::make_unique<CloserCandidates>();
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  Session session(c, std::move(parts));
  for (int view = 1; view <= 3; ++view) {
    session.step();
    const Vector3 at = session.next_view().translation();
    EXPECT_NEAR(at.head<2>().norm(), 1.0 - 0.1 * view, 1e-9);
    EXPECT_EQ(session.records().back().candidates.size(), 8u);
  }
}

TEST(OwnParts, ARecordingIsASourceLikeAnyOther) {
  Session simulated(small_scan());
  finish(simulated);
  std::vector<RecordedScan> recorded;
  for (std::size_t k = 0; k < simulated.scans().size(); ++k) {
    const Pose pose = simulated.records()[k].T_world_camera;
    recorded.push_back({pose, {}});
    for (const Eigen::Vector3f& point : simulated.scans()[k]->hits)
      recorded.back().points.push_back(pose.inverse() * point.cast<double>());
  }
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  c.cloud.outlier_removal = false;
  c.planner.gain = "fixed-order";
  SessionParts parts;
  parts.source = std::make_unique<RecordedSource>(recorded, c.sensor.max_range, simulated.camera());
  Session session(c, std::move(parts));
  EXPECT_EQ(session.candidates().size(), recorded.size()) << "the candidates are its frames";
  session.step();
  EXPECT_EQ(session.scans().back()->hits.size(), recorded.front().points.size());
  EXPECT_THAT(session.finished(), testing::IsEmpty());
}

}  // namespace
}  // namespace nextview
