#include "ui/window/behind_drawing.hpp"

#include <sys/resource.h>
#include <tbb/task_scheduler_observer.h>
#include <unistd.h>

namespace nextview {
namespace {

/// Of the usual 0 to 19: a ninth of the processor beside a thread that draws.
constexpr int behind = 10;

void put_behind() {
  const pid_t thread = ::gettid();  // the system's numbers: priorities are of threads, not of the process
  if (thread == ::getpid()) return;
  if (::getpriority(PRIO_PROCESS, id_t(thread)) < behind) ::setpriority(PRIO_PROCESS, id_t(thread), behind);
}

/// Of the threads that TBB lends to the one that made it. Nobody comes forward again: the system does not let them.
struct Helpers : tbb::task_scheduler_observer {
  Helpers() { observe(true); }
  ~Helpers() override { observe(false); }
  void on_scheduler_entry(bool) override { put_behind(); }
};

}  // namespace

void stay_behind_drawing() {
  if (::gettid() == ::getpid()) return;
  thread_local const Helpers helpers;
  put_behind();
}

}  // namespace nextview
