// The window's own sessions: how many stay, and which are offered.
#include "core/session/untitled_sessions.hpp"

#include <gmock/gmock.h>

#include <condition_variable>

#include "core/session/recent_files.hpp"
#include "tests/unit/workbench/kept_session_test.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using UntitledSessions = KeptSessionTest;

TEST_F(UntitledSessions, TheTenNewestStay) {
  for (int k = 0; k < 12; ++k) {
    auto one = runner();
    Configuration c = small_scan();
    c.evaluation.enabled = false;
    one->load(c, job_control());
    steps(*one, 1);
  }
  EXPECT_EQ(kept().size(), 10u);
}

/// Names begin with the time: one of an earlier hour than the ten others would be the first to go.
TEST_F(UntitledSessions, TheNewestStaysThoughTheClockWasSetBack) {
  Session session(small_scan());
  for (int k = 10; k < 20; ++k)
    SessionFolder::begin(OutputFolder(state() / fmt::format("2999-12-31 23.59.{} box", 3 * k), {}), session).close();
  const fs::path first = untitled_folder(state(), "sphere");
  EXPECT_EQ(first.filename(), "2999-12-31 23.59.58 sphere");
  SessionFolder::begin(OutputFolder(first, {}), session).close();
  EXPECT_EQ(untitled_folder(state(), "sphere").filename(), "2999-12-31 23.59.59 sphere");
  EXPECT_TRUE(fs::exists(first / "journal"));
  SessionFolder::begin(OutputFolder(state() / "2999-12-31 23.59.59 box", {}), session).close();
  EXPECT_EQ(untitled_folder(state(), "box").filename(), "3000-01-01 00.00.00 box");
  EXPECT_TRUE(fs::exists(first / "journal"));
}

TEST_F(UntitledSessions, WhatNobodyClosedIsOfferedOnce) {
  const fs::path folder = state() / "2026-01-01 00.00.00 box";
  {
    Session session(small_scan());
    SessionFolder ended = SessionFolder::begin(OutputFolder(folder, {}), session);
    ASSERT_TRUE(ended.step(session));
    ASSERT_TRUE(ended.step(session));
    EXPECT_FALSE(unfinished_session(state())) << "another program is at it";
  }
  const auto found = unfinished_session(state());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "box");
  EXPECT_EQ(found->views, 2u);
  for (const char* answer : {"Ask later", "Begin anew", "Go on"}) {
    std::mutex mutex;
    std::condition_variable news;
    SessionWorker worker([&] { news.notify_all(); });
    worker.keep_sessions(state());
    worker.post(request::OfferSession{*found});
    std::unique_lock lock(mutex);
    while (worker.progress().question.empty()) news.wait_for(lock, std::chrono::milliseconds(20));
    EXPECT_THAT(worker.progress().question, HasSubstr("box (2 views, "));
    worker.answer(answer);
    while (worker.progress().busy) news.wait_for(lock, std::chrono::milliseconds(20));
    EXPECT_EQ(worker.snapshot()->records.size(), std::string(answer) == "Go on" ? 2u : 0u);
    EXPECT_EQ(unfinished_session(state()).has_value(), std::string(answer) == "Ask later");
  }
  EXPECT_FALSE(unfinished_session(state()));
}

TEST_F(UntitledSessions, TheLastThatWasLeftIsFoundTheNextDay) {
  EXPECT_FALSE(last_session(state()));
  for (const int views : {3, 2, 0}) {
    auto one = runner();
    Configuration c = small_scan();
    c.evaluation.enabled = false;
    one->load(c, job_control());
    steps(*one, views);
    EXPECT_EQ(last_session(state()).has_value(), views < 3) << "this one is in use";
  }
  const auto last = last_session(state());
  ASSERT_TRUE(last);
  EXPECT_EQ(last->name, "sphere");
  EXPECT_EQ(last->views, 2u) << "one without views is none";
  EXPECT_EQ(recent_files(state()).front(), last->folder) << "among the recent files, too";
  EXPECT_FALSE(unfinished_session(state()));
  fs::remove_all(last->folder);
  EXPECT_EQ(last_session(state()).value().views, 3u);
}

TEST_F(UntitledSessions, AreKnownByTheirViewsCoverageAndTime) {
  auto one = runner();
  one->load(small_scan(), job_control());
  steps(*one, 2);
  const std::optional<EarlierSession> known = earlier_session(state(), kept().front());
  ASSERT_TRUE(known) << "though it is in use";
  EXPECT_EQ(known->name, "sphere");
  EXPECT_EQ(known->coverage, one->snapshot()->records.back().coverage_visible);
  EXPECT_NEAR(double(known->time), double(std::time(nullptr)), 60.0);
  EXPECT_FALSE(earlier_session(state(), folder_));
  std::tm day{};
  ASSERT_NE(::strptime("2026-03-01 14:05", "%Y-%m-%d %H:%M", &day), nullptr);
  day.tm_isdst = -1;
  const std::time_t time = std::mktime(&day);
  const EarlierSession session{"", "", 17, 0.9816, time};
  constexpr std::time_t of_a_day = 24 * 3600;
  EXPECT_EQ(session.summary(time + 3600), "17 views, 98.2 %, today 14:05");
  EXPECT_EQ(session.summary(time + of_a_day), "17 views, 98.2 %, yesterday 14:05");
  EXPECT_EQ(session.summary(time + 3 * of_a_day), "17 views, 98.2 %, 2026-03-01 14:05");
  EXPECT_EQ((EarlierSession{"", "", 1, {}, time}.summary(time)), "1 view, today 14:05");
}

TEST_F(UntitledSessions, AreAmongTheRecentFilesFromTheirFirstViewOn) {
  auto one = runner();
  one->load(small_scan(), job_control());
  EXPECT_TRUE(recent_files(state()).empty());
  steps(*one, 1);
  EXPECT_EQ(recent_files(state()), kept()) << "though nobody closed it";
}

TEST_F(UntitledSessions, HaveNoCoverageWhereNoneIsKnown) {
  Configuration without_truth = small_scan();
  without_truth.evaluation.enabled = false;
  auto one = runner();
  one->load(without_truth, job_control());
  steps(*one, 1);
  const std::optional<EarlierSession> known = earlier_session(state(), kept().front());
  ASSERT_TRUE(known);
  EXPECT_EQ(known->coverage, std::nullopt);
}

TEST_F(UntitledSessions, OneThatWasOpenedElsewhereIsOfferedToo) {
  const fs::path folder = folder_ / "a session of the day before";
  {
    Session session(small_scan());
    ASSERT_TRUE(SessionFolder::begin(OutputFolder(folder, {}), session).step(session));
  }
  EXPECT_FALSE(unfinished_session(state())) << "it was not opened here";
  add_recent_file(state(), folder);
  const auto found = unfinished_session(state());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->folder, folder);
  EXPECT_EQ(found->name, "a session of the day before");
  close_session(folder);
  EXPECT_FALSE(unfinished_session(state()));
}

}  // namespace
}  // namespace nextview
