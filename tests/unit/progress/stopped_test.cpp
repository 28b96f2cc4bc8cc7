#include "core/progress/stopped.hpp"

#include <gtest/gtest.h>

#include <string>

namespace nextview {
namespace {

TEST(ThrowIfStopped, DoesSoOnceAStopIsAskedForAndNotBefore) {
  std::stop_source stop;
  EXPECT_NO_THROW(throw_if_stopped({})) << "nobody can ask";
  EXPECT_NO_THROW(throw_if_stopped(stop.get_token()));
  stop.request_stop();
  EXPECT_THROW(throw_if_stopped(stop.get_token()), Stopped);
}

TEST(ThrowIfStopped, IsAnErrorThatSaysSo) { EXPECT_STREQ(Stopped().what(), "stopped"); }

}  // namespace
}  // namespace nextview
