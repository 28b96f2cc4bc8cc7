// Who computes leaves the processor to who draws.
#include "ui/window/behind_drawing.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <thread>

namespace nextview {
namespace {

int niceness() { return ::getpriority(PRIO_PROCESS, id_t(::gettid())); }

/// Of each thread that took part.
std::map<int, int> niceness_of_a_loop() {
  std::mutex mutex;
  std::map<int, int> found;
  tbb::parallel_for(0, 400, [&](int) {
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    const std::lock_guard lock(mutex);
    found[int(::gettid())] = niceness();
  });
  return found;
}

TEST(BehindDrawing, StayThoseThatComputeButNotTheMainThread) {
  const int before = niceness();
  std::map<int, int> computing;
  std::thread session([&] {
    stay_behind_drawing();
    stay_behind_drawing();
    computing = niceness_of_a_loop();
  });
  session.join();
  EXPECT_GE(computing.size(), 2u);
  for (const auto& [thread, nice] : computing) EXPECT_EQ(nice, std::max(before, 10)) << thread;
  stay_behind_drawing();
  EXPECT_EQ(niceness(), before);
}

}  // namespace
}  // namespace nextview
