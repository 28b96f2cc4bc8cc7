#include "ui/workbench/session_worker.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <fstream>

#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/workbench/small_scan.hpp"

namespace nextview {
namespace {

/// Steps of this one take a moment longer than it takes to cancel them.
Configuration slow_scan() {
  Configuration c = small_scan();
  c.sensor.width = 800;
  c.sensor.height = 600;
  return c;
}

class SessionWorkerTest : public testing::Test {
 protected:
  /// Waits, as the window does, for news that make `good` true.
  template <class Predicate>
  void wait_until(Predicate good) {
    std::unique_lock lock(mutex_);
    while (!good()) news_.wait_for(lock, std::chrono::milliseconds(20));
  }
  void wait_until_idle() {
    wait_until([&] { return !worker_.progress().busy; });
  }
  void load(const Configuration& configuration) {
    worker_.post(request::Load{configuration});
    wait_until_idle();
  }

  std::mutex mutex_;
  std::condition_variable news_;
  std::atomic<int> news_count_ = 0;
  SessionWorker worker_{[this] {
    ++news_count_;
    news_.notify_all();
  }};
};

TEST_F(SessionWorkerTest, StartsWithoutASession) {
  EXPECT_FALSE(worker_.snapshot()->loaded());
  worker_.post(request::Step{});
  worker_.post(request::Play{});
  worker_.post(request::TakeView{0});
  wait_until_idle();
  EXPECT_FALSE(worker_.snapshot()->loaded());
  EXPECT_EQ(worker_.snapshot()->message, "");
  EXPECT_FALSE(worker_.progress().playing);
}

TEST_F(SessionWorkerTest, LoadsReadyToStep) {
  load(small_scan());
  const auto s = worker_.snapshot();
  EXPECT_TRUE(s->loaded());
  EXPECT_EQ(s->object_name, "sphere");
  EXPECT_GT(s->mesh->triangles.size(), 100u);
  EXPECT_EQ(s->voxels->size(), s->grid.voxel_count());
  EXPECT_EQ(s->candidates.size(), 8u);
  EXPECT_TRUE(s->records.empty());
  EXPECT_TRUE(s->cloud->points.empty());
  EXPECT_FALSE(s->next_candidate.has_value()) << "the first view is the start view";
  EXPECT_GT(news_count_, 0);
}

TEST_F(SessionWorkerTest, LogsWhatMakesNoSenseOfASetUp) {
  const auto warnings = [&] {
    const auto log = worker_.log().entries();
    return std::count_if(log->begin(), log->end(), [](const LogEntry& e) {
      return e.level == LogEntry::Level::warning && e.text.find("inside the object") != std::string::npos;
    });
  };
  load(small_scan());
  EXPECT_EQ(warnings(), 0);
  Configuration c = small_scan();
  c.views.radius = 0.2;
  load(c);
  EXPECT_EQ(warnings(), 1);
}

TEST_F(SessionWorkerTest, LogsHowMuchOfAnExportsSurfacesWasSeen) {
  load(small_scan());
  worker_.post(request::Step{});
  const auto folder = std::filesystem::temp_directory_path() / ("nextview_export_" + std::to_string(::getpid()));
  worker_.post(request::Export{folder});
  wait_until_idle();
  std::filesystem::remove_all(folder);
  const auto log = worker_.log().entries();
  EXPECT_TRUE(std::any_of(log->begin(), log->end(),
                          [](const LogEntry& e) { return e.text.find("% of it was seen: ") != std::string::npos; }));
}

TEST_F(SessionWorkerTest, DoesWhatASessionDoes) {
  load(small_scan());
  for (int i = 0; i < 3; ++i) worker_.post(request::Step{});
  wait_until_idle();
  Session session(small_scan());
  std::size_t points = 0;
  for (int i = 0; i < 3; ++i) {
    session.step();
    points += session.scans().back()->hits.size();
  }
  const auto s = worker_.snapshot();
  ASSERT_EQ(s->records.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(s->records[i].view, session.records()[i].view);
    EXPECT_EQ(s->records[i].entropy, session.records()[i].entropy);
  }
  EXPECT_EQ(s->next_candidate, session.next_candidate());
  EXPECT_EQ(s->cloud->points.size(), points);
  const VoxelBricks& voxels = session.map().voxels();
  for (std::size_t v = 0; v < voxels.size(); ++v) ASSERT_EQ((*s->voxels)[v].probability, voxels[v].probability);
  ASSERT_NE(s->explanation, nullptr);
  EXPECT_NEAR(s->explanation->value, s->records.back().candidates[*s->next_candidate].gain, 1e-9);
}

TEST_F(SessionWorkerTest, ASnapshotNeverChanges) {
  load(small_scan());
  const auto before = worker_.snapshot();
  const std::vector<Voxel> voxels = *before->voxels;
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_NE(worker_.snapshot(), before);
  EXPECT_NE(worker_.snapshot()->map, before->map);
  EXPECT_TRUE(before->records.empty());
  for (std::size_t v = 0; v < voxels.size(); ++v) ASSERT_EQ((*before->voxels)[v].measured, voxels[v].measured);
}

TEST_F(SessionWorkerTest, PlaysUntilFinishedAndIgnoresStepsThen) {
  load(small_scan());
  worker_.post(request::Play{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->records.size(), 4u);
  EXPECT_FALSE(worker_.snapshot()->finished.empty());
  EXPECT_FALSE(worker_.progress().playing);
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->records.size(), 4u);
  EXPECT_EQ(worker_.snapshot()->message, "");
}

TEST_F(SessionWorkerTest, PauseFinishesTheStepThatRuns) {
  Configuration endless = small_scan();
  endless.views.count = 200;
  endless.termination.views = 200;
  load(endless);
  worker_.post(request::Play{});
  wait_until([&] { return worker_.snapshot()->records.size() >= 2; });
  worker_.post(request::Pause{});
  wait_until_idle();
  const std::size_t steps = worker_.snapshot()->records.size();
  EXPECT_LT(steps, 200u);
  EXPECT_FALSE(worker_.progress().playing);
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->records.size(), steps + 1);
}

TEST_F(SessionWorkerTest, ResetStartsOver) {
  load(small_scan());
  worker_.post(request::Step{});
  worker_.post(request::Step{});
  wait_until_idle();
  const auto before = worker_.snapshot();
  worker_.post(request::Reset{});
  wait_until_idle();
  const auto after = worker_.snapshot();
  EXPECT_TRUE(after->records.empty());
  EXPECT_TRUE(after->cloud->points.empty());
  EXPECT_GT(after->session, before->session);
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->records[0].entropy, before->records[0].entropy);
}

TEST_F(SessionWorkerTest, ALoadTakesThePlaceOfWhatWaits) {
  load(small_scan());
  for (int i = 0; i < 4; ++i) worker_.post(request::Step{});
  Configuration other = small_scan();
  other.object.file = "box";
  worker_.post(request::Load{other});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->object_name, "box");
  EXPECT_TRUE(worker_.snapshot()->records.empty());
  EXPECT_EQ(worker_.snapshot()->message, "");
}

TEST_F(SessionWorkerTest, CancelLeavesAWholeSession) {
  load(slow_scan());
  worker_.post(request::Step{});
  worker_.post(request::Step{});
  wait_until([&] { return worker_.progress().what == "taking the view"; });
  worker_.cancel();
  wait_until_idle();
  const auto s = worker_.snapshot();
  EXPECT_LE(s->records.size(), 1u) << "what waited was not dropped";
  EXPECT_EQ(s->message, "");
  worker_.post(request::Step{});
  wait_until_idle();
  Session session(slow_scan());
  session.step();
  if (s->records.empty()) {  // otherwise the step was already in the map when the cancelling arrived
    EXPECT_EQ(worker_.snapshot()->records[0].entropy, session.records()[0].entropy);
  }
}

TEST_F(SessionWorkerTest, ABadRequestIsAMessageAndTheSessionStays) {
  load(small_scan());
  worker_.post(request::Step{});
  worker_.post(request::OpenFile{"/no/such/file.stl"});
  wait_until_idle();
  EXPECT_NE(worker_.snapshot()->message.find("/no/such/file.stl"), std::string::npos);
  Configuration bad = small_scan();
  bad.map.resolution = -1;
  worker_.post(request::Load{bad});
  wait_until_idle();
  EXPECT_NE(worker_.snapshot()->message.find("map.resolution"), std::string::npos) << worker_.snapshot()->message;
  worker_.post(request::TakeView{1000});
  wait_until_idle();
  EXPECT_NE(worker_.snapshot()->message.find("1000"), std::string::npos) << worker_.snapshot()->message;
  EXPECT_EQ(worker_.snapshot()->object_name, "sphere");
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->message, "");
}

TEST_F(SessionWorkerTest, TakesTheViewThatAPersonChose) {
  load(small_scan());
  worker_.post(request::Step{});
  wait_until_idle();
  const auto before = worker_.snapshot();
  const std::size_t other = *before->proposal() == 2 ? 3 : 2;
  worker_.post(request::TakeView{other});
  wait_until_idle();
  const auto chosen = worker_.snapshot();
  EXPECT_EQ(chosen->next_candidate, other);
  EXPECT_EQ(chosen->proposal(), before->proposal());
  EXPECT_EQ(chosen->map, before->map) << "choosing a view measures nothing";
  EXPECT_EQ(&*chosen->voxels, &*before->voxels);
  EXPECT_TRUE(chosen->next_view.isApprox(chosen->candidates[other]));
  worker_.post(request::Step{});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->records.back().view, int(other));
  EXPECT_TRUE(worker_.snapshot()->records.back().overridden);
}

TEST_F(SessionWorkerTest, OpensAConfigurationFile) {
  load(small_scan());
  const TemporaryFolder own;
  const auto file = own / "worker.toml";
  std::ofstream(file) << "[planner]\ngain = \"farthest\"\n";
  worker_.post(request::OpenFile{file});
  wait_until_idle();
  EXPECT_EQ(worker_.snapshot()->message, "");
  EXPECT_EQ(worker_.snapshot()->configuration.planner.gain, "farthest");
  EXPECT_EQ(worker_.snapshot()->configuration.views.count, 8) << "what the file leaves out stays";
}

TEST(SessionWorkerLife, EndsWhileItPlays) {
  Configuration endless = small_scan();
  endless.views.count = 200;
  endless.termination.views = 200;
  SessionWorker worker;
  worker.post(request::Load{endless});
  worker.post(request::Play{});
  while (worker.snapshot()->records.empty()) std::this_thread::yield();
}

TEST_F(SessionWorkerTest, AnswersFromManyThreads) {
  std::atomic<bool> end = false;
  std::vector<std::jthread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      while (!end) {
        const auto s = worker_.snapshot();
        EXPECT_EQ(s->loaded() ? s->voxels->size() : 0, s->grid.voxel_count());
        EXPECT_LE(worker_.progress().fraction, 1.0);
      }
    });
  }
  load(small_scan());
  worker_.post(request::Play{});
  wait_until_idle();
  end = true;
  EXPECT_EQ(worker_.snapshot()->records.size(), 4u);
}

}  // namespace
}  // namespace nextview
