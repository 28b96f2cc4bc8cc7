#pragma once
#include <atomic>
#include <chrono>
#include <functional>

#include "ui/workbench/answer_thread.hpp"
#include "ui/workbench/found_surface.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {

/// Inspects on a thread of its own, also while the session worker is busy: snapshots never change. Surfaces, which take
/// longer, are made on another.
class InspectionWorker {
 public:
  /// `on_news` is called, from these threads, when there is another answer.
  explicit InspectionWorker(std::function<void()> on_news = {});

  /// Takes the place of what was asked and is not answered yet.
  void ask(std::shared_ptr<const SessionSnapshot> session, const Selection& selection) {
    inspections_.ask({std::move(session), selection});
  }
  std::shared_ptr<const Inspection> answer() const { return inspections_.answer(); }  ///< the latest; never null

  void ask_surface(const SurfaceQuestion& question);
  void drop_surface() { surfaces_.drop(); }
  std::shared_ptr<const FoundSurface> surface() const { return surfaces_.answer(); }  ///< likewise
  std::optional<SurfaceJob> surface_progress() const;                                 ///< none if none is being made

  bool busy() const { return inspections_.busy() || surfaces_.busy(); }

 private:
  struct Question {
    std::shared_ptr<const SessionSnapshot> session;
    Selection selection;
  };

  Inspector inspector_;  ///< the thread's alone
  std::atomic<double> surface_fraction_ = 0.0;
  std::chrono::steady_clock::time_point surface_asked_;
  AnswerThread<Question, Inspection> inspections_;
  AnswerThread<SurfaceQuestion, FoundSurface> surfaces_;
};

}  // namespace nextview
