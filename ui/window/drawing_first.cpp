#include "ui/window/drawing_first.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace nextview {
namespace {

/// Of the usual 0 to 19: a ninth of the processor beside a thread that draws.
constexpr int behind = 10;

}  // namespace

DrawingFirst::DrawingFirst() : drawing_(::gettid()) { observe(true); }

DrawingFirst::~DrawingFirst() { observe(false); }

void DrawingFirst::on_scheduler_entry(bool) {
  const int thread = ::gettid();
  if (thread == drawing_) return;
  // Of a thread, not of the process, on Linux.
  if (::getpriority(PRIO_PROCESS, id_t(thread)) < behind) ::setpriority(PRIO_PROCESS, id_t(thread), behind);
}

}  // namespace nextview
