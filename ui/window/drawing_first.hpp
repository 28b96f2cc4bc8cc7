#pragma once
#include <tbb/task_scheduler_observer.h>

namespace nextview {

/// While it is there, threads that compute with TBB leave the processor to the thread that made it, and to those that
/// draw for it: a window follows the hand while a step is under way. They get what is left, which is nearly all where
/// nothing is drawn. They stay behind until they end, as the system lets nobody come forward again.
class DrawingFirst : public tbb::task_scheduler_observer {
 public:
  DrawingFirst();
  ~DrawingFirst() override;
  void on_scheduler_entry(bool is_worker) override;

 private:
  int drawing_;  ///< the thread, as the system numbers it
};

}  // namespace nextview
