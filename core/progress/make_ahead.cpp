#include "core/progress/make_ahead.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <vector>

namespace nextview {

void make_ahead(std::size_t count, const Nth& begin, const Nth& make, const Nth& take) {
  std::vector<std::exception_ptr> failures(std::size_t(std::clamp(tbb::this_task_arena::max_concurrency(), 1, 8)));
  for (std::size_t i = 0; i < count; ++i) {
    begin(i);
    if (i % failures.size() == 0)
      tbb::parallel_for(i, std::min(count, i + failures.size()), [&](std::size_t next) {
        try {
          make(next);
        } catch (...) {
          failures[next - i] = std::current_exception();
        }
      });
    if (const std::exception_ptr& failure = failures[i % failures.size()]) std::rethrow_exception(failure);
    take(i);
  }
}

}  // namespace nextview
