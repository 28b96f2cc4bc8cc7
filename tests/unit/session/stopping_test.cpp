// A stop, or a failure, at any moment of a step leaves the session as it was before.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/progress/stopped.hpp"
#include "core/session/scan_loop.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// What each kind of session has to take back.
std::vector<Configuration> kinds_of_sessions() {
  std::vector<Configuration> kinds(5, small_scan());
  kinds[0].planner.gain = "proximity-count";  // marks occlusions
  kinds[1].map.insertion = Insertion::local_octree;
  kinds[2].planner.gain = "gibbs";
  kinds[2].gibbs.view_sweeps = 8;
  kinds[3].planner.semantics = Semantics::reference;
  kinds[3].planner.gain = "area-factor";
  kinds[4].planner.gain = "oracle";
  return kinds;
}

/// Sessions of the same views: one that nobody ever stopped, and one that is stopped.
struct Twins {
  explicit Twins(const Configuration& c) : untouched(c), stopped(c) {}
  Session untouched, stopped;
};

bool same_refinement(const Session& a, const Session& b) {
  if (!a.refinement() || !b.refinement()) return a.refinement() == b.refinement();
  return a.refinement()->posterior().occupied == b.refinement()->posterior().occupied &&
         a.refinement()->measurements().rays.size() == b.refinement()->measurements().rays.size() &&
         std::ranges::equal(a.planning_voxels(), b.planning_voxels(), [](const Voxel& x, const Voxel& y) {
           return x.probability == y.probability && x.measured == y.measured;
         });
}

TEST(StoppingASession, AtEachReportItIsAsBefore) {
  for (const Configuration& c : kinds_of_sessions()) {
    Twins twins(c);
    for (int step = 0; step < 3; ++step) {
      int stops = 0;
      for (int moment = 0;; ++moment) {
        std::stop_source stop;
        int calls = 0;
        const Progress stop_there = [&](double fraction, std::string_view) {
          if (calls++ == moment && fraction < 1.0) stop.request_stop();
        };
        if (twins.stopped.step(stop_there, stop.get_token())) break;
        ++stops;
        EXPECT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain << ", report " << moment;
        EXPECT_TRUE(same_refinement(twins.stopped, twins.untouched)) << c.planner.gain << ", report " << moment;
      }
      EXPECT_GE(stops, 2) << c.planner.gain << ": it went on to its end";
      twins.untouched.step();
      EXPECT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain << ": a stop left something behind";
      EXPECT_TRUE(same_refinement(twins.stopped, twins.untouched)) << c.planner.gain;
    }
  }
}

// Between the reports too: a stop that comes from elsewhere, a little later each time.
TEST(StoppingASession, AtAnyOtherMomentItIsAsBefore) {
  for (const Configuration& c : kinds_of_sessions()) {
    Twins twins(c);
    for (int step = 0; step < 2; ++step) {
      int stops = 0;
      for (int wait = 0;; wait += 1 + wait / 8) {  // finer at the beginning: a step may take long
        std::stop_source stop;
        std::atomic<bool> begun = false;
        std::jthread stopper([&] {
          begun.wait(false);
          std::this_thread::sleep_for(std::chrono::microseconds(500 * wait));
          stop.request_stop();
        });
        const bool taken = twins.stopped.step(
            [&](double, std::string_view) {
              begun = true;
              begun.notify_all();
              if (wait == 0) stop.request_stop();  // the other thread may be late, but one stop there is
            },
            stop.get_token());
        if (taken) break;
        ++stops;
        ASSERT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain << ", after " << wait / 2.0 << " ms";
      }
      twins.untouched.step();
      EXPECT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain << ": a stop left something behind";
      EXPECT_TRUE(same_refinement(twins.stopped, twins.untouched)) << c.planner.gain;
      EXPECT_GT(stops, 0);
    }
  }
}

TEST(StoppingASession, AFailureAtAnyMomentLeavesItAsBefore) {
  for (const Configuration& c : kinds_of_sessions()) {
    Twins twins(c);
    int failures = 0;
    for (int moment = 0;; ++moment) {
      int calls = 0;
      const Progress fail_there = [&](double fraction, std::string_view) {
        if (calls++ == moment && fraction < 1.0) throw std::bad_alloc();
      };
      try {
        twins.stopped.step(fail_there);
        break;
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("32 x 32 x 32 voxels"), std::string::npos) << error.what();
        ++failures;
      }
      EXPECT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain << ", report " << moment;
    }
    EXPECT_GE(failures, 2) << c.planner.gain << ": it went on to its end";
    twins.untouched.step();
    EXPECT_TRUE(same_scan(twins.stopped, twins.untouched)) << c.planner.gain;
  }
}

/// While it is asked for what it can reach, somebody stops the plan.
class StoppedRobot : public FreeFlyingCamera {
 public:
  using FreeFlyingCamera::FreeFlyingCamera;
  std::vector<Reach> reach(const Pose& from, std::span<const View> views) override {
    stop.request_stop();
    return FreeFlyingCamera::reach(from, views);
  }
  std::stop_source stop;
};

// As after a session was opened again whose earlier views said it: it takes as long as several views of a large object.
TEST(StoppingASession, WhatCandidatesSeeIsNotLookedForAfterwards) {
  const Configuration c = kinds_of_sessions()[4];
  Session scanned(c), opened(c);
  scanned.step();
  StoppedRobot robot(Pose::Identity());
  EXPECT_THROW(plan(opened.setup(), scanned.state(), robot, {}, {}, robot.stop.get_token()), Stopped);
  int told = 0;
  opened.known_object()->sight([&](double, std::string_view) { ++told; });
  EXPECT_GT(told, 0) << "it was looked for all the same";
}

TEST(StoppingASession, WhatCannotFitIsRefusedBeforeItIsTried) {
  Configuration images = small_scan();
  images.sensor.width = images.sensor.height = 16384;
  images.termination.views = 10'000;
  images.views.count = 10'000;
  try {
    const Session session(images);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("a scan of 10000 images of 16384 x 16384 pixels needs ")) << text;
    EXPECT_NE(text.find("(sensor.width, sensor.height)"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace nextview
