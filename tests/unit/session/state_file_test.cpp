// What makes a session quick to open: the same to the bit as taking its views again, or not used.
#include "core/session/state_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "core/map/octree_file.hpp"
#include "core/session/session_folder.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

class StateFile : public testing::Test {
 protected:
  fs::path path() const { return folder_ / "session"; }
  fs::path file() const { return path() / state_file_name; }
  std::unique_ptr<Session> scan(const Configuration& configuration, int views = 3) const {
    auto session = std::make_unique<Session>(configuration);
    SessionFolder folder = SessionFolder::begin(OutputFolder(path(), {}), *session);
    for (int k = 0; k < views && session->finished().empty(); ++k) EXPECT_TRUE(folder.step(*session));
    folder.keep_state(*session);
    folder.close();
    return session;
  }
  /// Null if what was kept is not used.
  std::unique_ptr<Session> opened() const {
    const SavedSession saved = read_session(path());
    auto session = std::make_unique<Session>(saved.configuration);
    return restore_kept(*session, saved, nullptr) ? std::move(session) : nullptr;
  }
  TemporaryFolder folder_;
};

void expect_same(const Session& a, const Session& b) {
  EXPECT_TRUE(same_scan(a, b));
  EXPECT_EQ(a.next_view().matrix(), b.next_view().matrix());
  EXPECT_EQ(a.next_candidate(), b.next_candidate());
  EXPECT_EQ(a.finished(), b.finished());
  ASSERT_EQ(a.records().size(), b.records().size());
  for (std::size_t k = 0; k < a.records().size(); ++k) {
    const StepRecord &x = a.records()[k], &y = b.records()[k];
    EXPECT_NEAR(x.seconds.insert, y.seconds.insert, 1e-6) << "what it took is told as it was";
    EXPECT_EQ(x.quality.log_loss, y.quality.log_loss);
    EXPECT_EQ(x.quality_near_surface.reliability[3].voxels, y.quality_near_surface.reliability[3].voxels);
    EXPECT_EQ(x.ranking.reason, y.ranking.reason);
    EXPECT_EQ(x.surface_left, y.surface_left);
  }
  for (std::size_t k = 0; k < a.scans().size(); ++k) {
    EXPECT_EQ(a.scans()[k]->hits, b.scans()[k]->hits);
    EXPECT_EQ(a.scans()[k]->misses, b.scans()[k]->misses);
    EXPECT_EQ(a.scans()[k]->origin, b.scans()[k]->origin);
  }
}

TEST_F(StateFile, IsTheSessionToTheBitAndGoesOnTheSame) {
  for (const char* gain : {"new-surface", "proximity-count", "oracle"}) {
    SCOPED_TRACE(gain);
    fs::remove_all(path());
    Configuration c = small_scan();
    c.planner.gain = gain;
    const auto session = scan(c, 2);
    const auto is = opened();
    ASSERT_TRUE(is);
    expect_same(*session, *is);
    session->step();
    is->step();
    EXPECT_TRUE(same_scan(*session, *is));
  }
}

TEST_F(StateFile, WithoutTruthAndOfMovedAndDownSampledCloudsToo) {
  Configuration c = small_scan();
  c.evaluation.enabled = false;
  c.cloud.down_sampling = true;
  c.cloud.down_sampling_leaf = 0.02;
  c.registration.mode = RegistrationConfig::Mode::correct;
  c.robot.position_error = 0.002;
  const auto session = scan(c);
  const auto is = opened();
  ASSERT_TRUE(is);
  EXPECT_TRUE(same_scan(*session, *is));
  EXPECT_EQ(is->records()[1].registration.has_value(), session->records()[1].registration.has_value());
}

TEST_F(StateFile, EarlierStatesAreThoseOfThen) {
  Session session(small_scan());
  std::vector<ScanState> states;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(session.step());
    states.push_back(session.state());
  }
  for (std::size_t k = 1; k < 3; ++k) {
    ScanState earlier = earlier_state(session.setup(), session.state(), k, states[k - 1].T_world_camera);
    remake(session.setup(), earlier, nothing_scanned(session.setup(), {}), {}, {});
    Session then(small_scan());
    then.restore(earlier);
    Session was(small_scan());
    was.restore(states[k - 1]);
    EXPECT_TRUE(same_scan(was, then));
    EXPECT_EQ(then.next_view().matrix(), was.next_view().matrix());
    EXPECT_EQ(earlier.T_world_camera.matrix(), states[k - 1].T_world_camera.matrix());
  }
}

TEST_F(StateFile, IsNotThereWhereItWouldNotBeWhole) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.gibbs.view_sweeps = 4;
  scan(c, 1);
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_FALSE(opened());
  fs::remove_all(path());
  {
    Session session(c);
    SessionFolder folder = SessionFolder::begin(OutputFolder(path(), {}), session);
    ASSERT_TRUE(folder.step(session));
    PlannerConfig plain = session.configuration().planner;
    plain.gain = small_scan().planner.gain;
    session.set_planner(plain);
    folder.keep_configuration(session);
    folder.keep_state(session);
    ASSERT_TRUE(session.records().front().refinement);
  }
  EXPECT_FALSE(fs::exists(file())) << "it would not say what refining the first view did";
  fs::remove_all(path());
  c = small_scan();
  c.views.layout = ViewLayout::adaptive;
  scan(c, 2);
  EXPECT_FALSE(opened());
}

TEST_F(StateFile, OfAnythingElseIsNotUsed) {
  const auto session = scan(small_scan());
  ASSERT_TRUE(opened());
  {
    SavedSession saved = read_session(path());
    Session again(saved.configuration);
    SessionFolder folder = SessionFolder::go_on(OutputFolder(path(), {}), saved, again);
    ASSERT_TRUE(restore(again, saved, &folder));
    ASSERT_TRUE(folder.step(again));  // and it is ended here
  }
  EXPECT_FALSE(opened()) << "there is another view";
  fs::remove_all(path());
  scan(small_scan());
  SavedSession saved = read_session(path());
  saved.configuration.planner.gain = "random";
  Session other(saved.configuration);
  EXPECT_FALSE(restore_kept(other, saved, nullptr)) << "it is planned otherwise";
}

TEST_F(StateFile, AfterItsStartMapHasChangedIsNotUsed) {
  Configuration c = small_scan();
  c.map.start = (folder_ / "start.ot").string();
  Session before(small_scan());
  ASSERT_TRUE(before.step());
  write_octree(before.map(), c.map.start);
  scan(c, 1);
  ASSERT_TRUE(opened());
  ASSERT_TRUE(before.step());
  write_octree(before.map(), c.map.start);
  EXPECT_FALSE(opened());
}

TEST_F(StateFile, WithoutAllOfItsTimesItIsTheSameButForThem) {
  const auto session = scan(small_scan());
  const fs::path times = path() / "timings.csv";
  const std::string all = read_file(times);
  const std::size_t first = all.find('\n') + 1, second = all.find('\n', first) + 1;
  for (const std::string& some :
       {std::string(), all.substr(0, first), all.substr(0, second), all + "4,1,1,1,1,1,1\n"}) {
    write_file(times, some);
    const auto is = opened();
    ASSERT_TRUE(is) << some;
    EXPECT_TRUE(same_scan(*session, *is)) << some;
    EXPECT_EQ(is->records()[0].seconds.insert > 0.0, some.size() >= second) << some;
    EXPECT_EQ(is->records()[2].seconds.insert > 0.0, some.size() > all.size()) << some;
  }
  fs::remove(times);
  const auto is = opened();
  ASSERT_TRUE(is);
  EXPECT_TRUE(same_scan(*session, *is));
}

TEST_F(StateFile, WrittenTwiceIsTheSame) {
  scan(small_scan());
  const std::string first = read_file(file());
  fs::remove_all(path());
  scan(small_scan());
  EXPECT_TRUE(read_file(file()) == first) << "no second is in it";
}

/// Whatever its bytes are, also with a checksum that fits: right, or not used.
TEST_F(StateFile, DamagedIsNotUsed) {
  Configuration c = small_scan();
  c.evaluation.surface_samples = 100;
  const auto session = scan(c, 1);
  const std::string whole = read_file(file());
  const std::size_t head = whole.find('\n') + 1, content = head + 9;
  std::mt19937 random(4);
  int used = 0;
  for (int k = 0; k < 300; ++k) {
    std::string bytes = whole;
    const std::size_t at = content + random() % (k % 2 ? 4000u : unsigned(bytes.size() - content));
    switch (random() % 3) {
      case 0:
        bytes[at] = char(random());
        break;
      case 1:
        bytes.resize(at);
        break;
      default:
        for (std::size_t i = at; i < std::min(at + 8, bytes.size()); ++i) bytes[i] = char(0xFF);
    }
    if (k % 3 > 0) bytes.replace(head, 8, hash_of(std::string_view(bytes).substr(content)).crc32);
    write_file(file(), bytes);
    if (const auto is = opened()) {
      ++used;
      EXPECT_EQ(is->records().size(), 1u);
      EXPECT_EQ(is->scans()[0]->hits.size(), session->scans()[0]->hits.size());
    }
  }
  EXPECT_GT(used, 0) << "some numbers may be any";
  EXPECT_LT(used, 250);
  fs::remove(file());
  EXPECT_FALSE(opened());
}

}  // namespace
}  // namespace nextview
