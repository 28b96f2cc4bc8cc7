// A stop ends a request, whatever the driver can do and however long it may take.
#include <thread>

#include "tests/unit/driver/fake_scanner.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

TEST(DriverStop, EndsADriverThatCannotStop) {
  const FakeScanner fake("for-ever", 0.5);
  const auto connection = fake.connect();
  fake.misbehave("silence", "move");
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    stop.request_stop();
  });
  const Seconds seconds;
  const Failure failure = failure_of(connection->move(at(1, 0, 0), stop.get_token()));
  EXPECT_GT(seconds.passed(), 0.7) << "it is waited for longer than the time-out of others";
  EXPECT_LT(seconds.passed(), 0.8 + limit);
  EXPECT_EQ(failure.kind, Failure::cancelled);
  EXPECT_THAT(failure.reason, HasSubstr("no ability to stop"));
  fake.behave();
  EXPECT_FALSE(connection->reconnect());
  expect_all_is_well(*connection);
}

TEST(DriverStop, IsSentToADriverThatCan) {
  const FakeScanner fake("stop for-ever", 2.0);
  const auto connection = fake.connect();
  for (const char* request : {"move", "capture"}) {
    fake.misbehave("slow", request);
    std::stop_source stop;
    const std::jthread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      stop.request_stop();
    });
    const Failure failure = request == std::string("move") ? failure_of(connection->move(at(1, 0, 0), stop.get_token()))
                                                           : failure_of(connection->capture(1, 1, stop.get_token()));
    EXPECT_EQ(failure.kind, Failure::cancelled);
    EXPECT_THAT(failure.reason, HasSubstr(std::string(request) + ": stopped"));
    EXPECT_FALSE(connection->is_lost());
    fake.behave();
    expect_all_is_well(*connection);
  }
}

TEST(DriverStop, EndsWhoSaysItStopsAndDoesNot) {
  const FakeScanner fake("stop for-ever", 2.0);
  const auto connection = fake.connect();
  fake.misbehave("stubborn", "move");
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  const Seconds seconds;
  EXPECT_EQ(failure_of(connection->move(at(1, 0, 0), stop.get_token())).kind, Failure::cancelled);
  EXPECT_LT(seconds.passed(), limit);
}

TEST(DriverStop, BeforehandAsksNothing) {
  const FakeScanner fake;
  const auto connection = fake.connect();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(failure_of(connection->move(at(1, 0, 0), stop.get_token())).kind, Failure::cancelled);
  expect_all_is_well(*connection);
}

/// What it was doing when it was last heard of, it may still do.
TEST(DriverStop, IsSentToWhoIsNotWaitedForAnyMore) {
  const FakeScanner fake("stop", 0.5);
  const auto connection = fake.connect();
  fake.misbehave("slow", "move");
  EXPECT_THAT(failure_of(connection->move(at(1, 0, 0), {})).reason,
              HasSubstr("no answer within 0.5 s (driver.timeout)"));
  fake.behave();
  expect_all_is_well(*connection);  // it would not answer had it not been told to stop
}

}  // namespace
}  // namespace nextview
