// Scans whose poses are wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/evaluation/accuracy.hpp"
#include "core/registration/alignment.hpp"
#include "core/session/session.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// A camera that looks at the housing from a ring, so that each view overlaps the one before.
Configuration ring() {
  Configuration c;
  c.object.file = "slotted_housing";
  c.sensor.width = 160;
  c.sensor.height = 120;
  c.views.layout = ViewLayout::rings;
  c.views.rings = 1;
  c.views.count = 12;
  c.planner.gain = "fixed-order";
  c.planner.start_elevation = 0.0;
  c.termination = TerminationConfig::unlimited();
  c.termination.views = 8;
  c.evaluation.enabled = false;
  return c;
}

/// Mean distance of the points to the object, after they were aligned with it [m].
double error_of(const Session& session) {
  PointCloud cloud;
  for (const auto& scan : session.scans()) cloud.insert(cloud.end(), scan->hits.begin(), scan->hits.end());
  const TriangleMesh mesh = load_mesh(resolve_object("slotted_housing"), {.longest_side = 0.0});
  const Alignment alignment = align(cloud, mesh);
  for (Eigen::Vector3f& p : cloud) p = (alignment.T_surface_cloud * p.cast<double>()).cast<float>();
  return accuracy(cloud, MeshDistance(mesh)).mean;
}

double error_with(Configuration c) {
  Session session(c);
  finish(session);
  return error_of(session);
}

/// Each view of the ring sees one or two planes, which leave directions free: of eight seeds two stay near the wrong
/// poses.
TEST(RegisteredSession, CorrectsPosesThatAreWrong) {
  double exact = 0.0, wrong = 0.0, corrected = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Configuration c = ring();
    c.seed = seed;
    exact += error_with(c);
    c.robot = {0.004, 0.3};
    wrong += error_with(c);
    c.registration.mode = RegistrationConfig::Mode::correct;
    c.registration.beyond_limits = RegistrationConfig::Beyond::accept;
    corrected += error_with(c);
  }
  EXPECT_GT(wrong, 2.0 * exact);
  EXPECT_LT(corrected, 1.2 * exact);
}

TEST(RegisteredSession, TakesViewsThatCanBeRegistered) {
  Configuration c = ring();
  c.planner.gain = "new-surface";
  c.views = {};
  c.termination.views = 5;
  c.robot = {0.004, 0.3};
  c.registration.beyond_limits = RegistrationConfig::Beyond::accept;
  const auto registered = [&](RegistrationConfig::Mode mode) {
    c.registration.mode = mode;
    Session session(c);
    finish(session);
    return std::ranges::count_if(session.records(), [](const StepRecord& record) {
      return record.registration && record.registration->reliable;
    });
  };
  EXPECT_LT(registered(RegistrationConfig::Mode::check), 4) << "the best second view sees the other side";
  EXPECT_EQ(registered(RegistrationConfig::Mode::correct), 4);
}

TEST(RegisteredSession, OffChangesNothingAndCheckMovesNothing) {
  Configuration c = ring();
  c.termination.views = 3;
  Session plain(c);
  finish(plain);
  c.registration.mode = RegistrationConfig::Mode::check;
  c.registration.beyond_limits = RegistrationConfig::Beyond::accept;
  Session checked(c);
  finish(checked);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(plain.scans()[k]->hits, checked.scans()[k]->hits);
    EXPECT_FALSE(plain.records()[k].registration);
    EXPECT_EQ(bool(checked.records()[k].registration), k > 0) << "the first has none before it";
  }
}

TEST(RegisteredSession, TheOperatorJudgesWhatIsFarOff) {
  Configuration c = ring();
  c.robot = {0.03, 0.0};
  c.registration.mode = RegistrationConfig::Mode::check;
  Session session(c);
  session.step();
  EXPECT_THROW(session.step(), std::runtime_error) << "no one is there to be asked";
  EXPECT_EQ(session.records().size(), 1u);
  std::string reason;
  Session::Verdict verdict = Session::Verdict::reject;
  session.set_judge([&](const Acquired&, const std::string& why) {
    reason = why;
    return verdict;
  });
  EXPECT_FALSE(session.step());
  EXPECT_EQ(session.records().size(), 1u);
  EXPECT_THAT(reason, testing::Not(testing::IsEmpty()));
  verdict = Session::Verdict::correct;
  EXPECT_TRUE(session.step());
  const StepRecord& record = session.records().back();
  ASSERT_TRUE(record.registration);
  EXPECT_GT(record.registration->shift, 0.004);
}

}  // namespace
}  // namespace nextview
