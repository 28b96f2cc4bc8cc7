// A race within a loop of oneTBB, to see that tbb_happens_before.cpp does not hide it: the thread sanitizer must end
// this with its exit code.
#include <oneapi/tbb/parallel_for.h>

#include <cstdio>

int main() {
  int sum = 0;
  tbb::parallel_for(0, 1 << 20, [&](int i) { sum += i; });
  std::printf("%d\n", sum);
}
