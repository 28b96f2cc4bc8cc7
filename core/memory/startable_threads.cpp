#include "core/memory/startable_threads.hpp"

#include <latch>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace nextview {

int startable_threads(int wanted) {
  std::latch counted(1);
  std::vector<std::jthread> threads;
  try {
    for (int n = 0; n < wanted; ++n) threads.emplace_back([&] { counted.wait(); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  counted.count_down();
  return static_cast<int>(threads.size());
}

}  // namespace nextview
