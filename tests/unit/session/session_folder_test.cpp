// A session as a folder: whatever ended it, it goes on to the same bytes; whatever is lost of it is said.
#include "core/session/session_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SessionFolderTest : public testing::Test {
 protected:
  fs::path path() const { return folder_ / "session"; }
  SessionFolder begin(Session& session) const { return SessionFolder::begin(OutputFolder(path(), {}), session); }
  /// A session of so many views, kept.
  std::unique_ptr<Session> scan(int views) const {
    auto session = std::make_unique<Session>(small_scan());
    SessionFolder folder = begin(*session);
    for (int k = 0; k < views; ++k) EXPECT_TRUE(folder.step(*session));
    return session;
  }
  /// What the folder says of it.
  std::unique_ptr<Session> again(std::vector<std::string>* notices = nullptr) const {
    SavedSession saved = read_session(path());
    auto session = std::make_unique<Session>(saved.configuration);
    EXPECT_TRUE(restore(*session, saved, nullptr));
    if (notices) *notices = saved.notices;
    return session;
  }
  /// A step that is stopped when its capture is kept.
  static bool stopped_step(SessionFolder& folder, Session& session) {
    std::stop_source stop;
    const Progress stops = [&](double fraction, std::string_view) {
      if (fraction > 0.3) stop.request_stop();
    };
    return folder.step(session, stops, stop.get_token());
  }
  TemporaryFolder folder_;
};

void expect_same(const Session& a, const Session& b) {
  EXPECT_TRUE(same_scan(a, b));
  EXPECT_EQ(a.next_view().matrix(), b.next_view().matrix());
}

TEST_F(SessionFolderTest, IsRestoredToTheBit) {
  const auto session = scan(3);
  expect_same(*session, *again());
}

TEST_F(SessionFolderTest, GoesOnAsIfNothingHadHappened) {
  const auto whole = scan(4);
  fs::remove_all(path());
  scan(2);
  SavedSession saved = read_session(path());
  Session session(saved.configuration);
  SessionFolder folder = SessionFolder::go_on(OutputFolder(path(), {}), saved, session);
  ASSERT_TRUE(restore(session, saved, &folder));
  ASSERT_TRUE(folder.step(session));
  ASSERT_TRUE(folder.step(session));
  expect_same(*whole, session);
  expect_same(*whole, *again());
}

TEST_F(SessionFolderTest, ChoicesOfTheOperatorAreKept) {
  Session session(small_scan());
  SessionFolder folder = begin(session);
  ASSERT_TRUE(folder.step(session));
  const auto& candidates = session.records().back().candidates;
  std::size_t other = 0;
  while (!candidates[other].available || other == session.next_candidate()) ++other;
  session.override_next_view(other);
  ASSERT_TRUE(folder.step(session));
  session.override_next_view(look_at({0.7, 0.5, 0.4}, Vector3::Zero()));
  ASSERT_TRUE(folder.step(session));
  const auto restored = again();
  expect_same(session, *restored);
  EXPECT_TRUE(restored->records()[1].overridden);
  EXPECT_EQ(restored->records()[2].view, -1);
}

TEST_F(SessionFolderTest, AnotherPlannerOnTheWayIsKept) {
  Session session(small_scan());
  SessionFolder folder = begin(session);
  ASSERT_TRUE(folder.step(session));
  for (const char* gain : {"rear-side-voxel", "gibbs", "new-surface"}) {  // occlusions, a posterior, and neither
    PlannerConfig planner = session.configuration().planner;
    planner.gain = gain;
    session.set_planner(planner);
    folder.keep_configuration(session);
    ASSERT_TRUE(folder.step(session));
  }
  const auto restored = again();
  EXPECT_EQ(restored->configuration().planner.gain, "new-surface");
  ASSERT_EQ(restored->records().size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_TRUE(same_candidates(session.records()[k].candidates, restored->records()[k].candidates)) << k;
  EXPECT_TRUE(same_map_but_for_occlusions(session.map(), restored->map()));
}

TEST_F(SessionFolderTest, AViewThatWasCapturedAndNotAbsorbedIsTakenThen) {
  const auto whole = scan(2);
  fs::remove_all(path());
  Session session(small_scan());
  {
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
    const Progress ends = [](double fraction, std::string_view) {
      if (fraction > 0.3) throw std::runtime_error("ended");
    };
    EXPECT_THROW(folder.step(session, ends), std::runtime_error);
  }
  expect_same(*whole, *again());
}

TEST_F(SessionFolderTest, AViewThatWasStoppedAfterItsCaptureIsTakenByWhoGoesOn) {
  const auto whole = scan(2);
  fs::remove_all(path());
  Session session(small_scan());
  {
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
    EXPECT_FALSE(stopped_step(folder, session));
    folder.close();
  }
  expect_same(*whole, *again());
}

TEST_F(SessionFolderTest, AViewThatWasCancelledIsNotWhereTheSessionStandsWithoutIt) {
  Session session(small_scan());
  {
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
    EXPECT_FALSE(stopped_step(folder, session));
    folder.stand_at(folder.line());
  }
  expect_same(session, *again());
}

TEST_F(SessionFolderTest, AViewThatWasStoppedIsNoBranchOfTheOneThatIsTakenInstead) {
  Session session(small_scan());
  {
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
    EXPECT_FALSE(stopped_step(folder, session));
    ASSERT_TRUE(folder.step(session));
  }
  expect_same(session, *again());
  EXPECT_EQ(read_journal(path()).branches.all.size(), 1u);
}

TEST_F(SessionFolderTest, StandsWhereItWentBackTo) {
  Session session(small_scan());
  {
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
    const ScanState one = session.state();
    const SessionFolder::Line line = folder.line();
    ASSERT_TRUE(folder.step(session));
    ASSERT_TRUE(folder.step(session));
    session.restore(one);
    folder.stand_at(line);
    session.override_next_view(look_at({0.7, 0.5, 0.4}, Vector3::Zero()));
    ASSERT_TRUE(folder.step(session));
  }
  expect_same(session, *again());
  EXPECT_EQ(read_journal(path()).steps.size(), 4u) << "the other branch is there";
}

TEST_F(SessionFolderTest, AnEarlierVersionsViewsAreSensedAgain) {
  const auto session = scan(3);
  fs::remove(path() / "journal");
  fs::remove_all(path() / "scans");
  std::string csv = "step,view,x[m],y[m],z[m],qx,qy,qz,qw\n";
  for (const StepRecord& r : session->records()) {
    const Vector3 p = r.T_world_camera.translation();
    const Eigen::Quaterniond q(r.T_world_camera.linear());
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.step, r.view, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  write_file(path() / "views.csv", csv);
  std::vector<std::string> notices;
  expect_same(*session, *again(&notices));
  EXPECT_THAT(notices, testing::Contains(HasSubstr("sensed again")));
}

TEST_F(SessionFolderTest, ALostScanIsLeftOutAndSaid) {
  scan(3);
  fs::remove(path() / "scans/0002.npy");
  std::vector<std::string> notices;
  const auto session = again(&notices);
  EXPECT_EQ(session->records().size(), 2u);
  EXPECT_THAT(notices, testing::ElementsAre(HasSubstr("a view is left out")));
}

TEST_F(SessionFolderTest, ItsSettingsHoldWhateverBecameOfTheirFile) {
  const auto session = scan(2);
  for (const char* text : {"", "seed = 2\n", "no toml"}) {
    write_file(path() / "config.toml", text);
    std::vector<std::string> notices;
    expect_same(*session, *again(&notices));
    EXPECT_EQ(notices.size(), 1u);
  }
  fs::remove(path() / "config.toml");
  expect_same(*session, *again());
}

TEST_F(SessionFolderTest, AChangedObjectIsRefused) {
  fs::copy_file(resolve_object("box"), folder_ / "part.ply");
  Configuration c = small_scan();
  c.object.file = (folder_ / "part.ply").string();
  {
    Session session(c);
    SessionFolder folder = begin(session);
    ASSERT_TRUE(folder.step(session));
  }
  EXPECT_NO_THROW(read_session(path()));
  write_file(folder_ / "part.ply", read_file(folder_ / "part.ply") + "\n");
  EXPECT_THROW(read_session(path()), std::runtime_error);
}

TEST_F(SessionFolderTest, WhereNothingCanBeKeptItSaysSoAndGoesOn) {
  Session session(small_scan()), other(small_scan());
  SessionFolder folder = begin(session);
  ASSERT_TRUE(folder.step(session));
  ASSERT_TRUE(other.step());
  fs::remove_all(path());
  write_file(path(), "a file in its place");
  EXPECT_THROW(folder.step(session), std::runtime_error);
  EXPECT_EQ(session.records().size(), 1u) << "without anyone to hear it nothing is taken";
  std::vector<std::string> heard;
  const auto hear = [&](const std::string& reason) { heard.push_back(reason); };
  ASSERT_TRUE(folder.step(session, {}, {}, hear));
  ASSERT_TRUE(folder.step(session, {}, {}, hear));
  ASSERT_TRUE(other.step());
  ASSERT_TRUE(other.step());
  EXPECT_EQ(heard.size(), 1u);
  EXPECT_FALSE(folder.keeps());
  expect_same(other, session);
}

TEST_F(SessionFolderTest, ACopyIsASessionOfItsOwn) {
  Session session(small_scan());
  SessionFolder folder = begin(session);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(folder.step(session));
  OutputFolder copy(folder_ / "copy", {});
  copy.begin("scan");
  folder.copy_to(copy, session);
  fs::remove_all(path());
  fs::rename(folder_ / "copy", path());
  expect_same(session, *again());
}

/// 10,000 by NEXTVIEW_DAMAGED_SESSIONS=10000, some here.
TEST_F(SessionFolderTest, DamagedAnyhowItIsRefusedOrSaidOrRight) {
  const char* wanted = std::getenv("NEXTVIEW_DAMAGED_SESSIONS");
  const int samples = wanted ? std::atoi(wanted) : 150;
  const auto session = scan(2);
  const fs::path whole = folder_ / "whole";
  fs::copy(path(), whole, fs::copy_options::recursive);
  const std::vector<fs::path> files = {"journal",        "journal",        "config.toml",
                                       "scans/0001.npy", "scans/0002.npy", "manifest.json"};
  std::mt19937 random(1);
  int refused = 0, said = 0, right = 0;
  for (int k = 0; k < samples; ++k) {
    fs::remove_all(path());
    fs::copy(whole, path(), fs::copy_options::recursive);
    const fs::path file = path() / files[random() % files.size()];
    std::string bytes = read_file(file);
    const std::size_t at = random() % bytes.size();
    switch (random() % 3) {
      case 0:
        bytes[at] = char(bytes[at] ^ (1 << random() % 8));
        write_file(file, bytes);
        break;
      case 1:
        write_file(file, bytes.substr(0, at));
        break;
      default:
        fs::remove(file);
    }
    std::unique_ptr<Session> is;
    std::vector<std::string> notices;
    try {
      is = again(&notices);
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(), HasSubstr(path().string())) << "it names the file";
      ++refused;
      continue;
    }
    ASSERT_LE(is->records().size(), 2u);
    if (is->records().size() == 2) {
      expect_same(*session, *is);
      ++right;
    } else {
      said += !notices.empty();
      // A journal that was cut at the end of a record says nothing of what followed.
      EXPECT_TRUE(!notices.empty() || file.filename() == "journal");
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(said, 0);
  EXPECT_GT(right, 0);
}

}  // namespace
}  // namespace nextview
