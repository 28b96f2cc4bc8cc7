#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "ui/workbench/inspector.hpp"

namespace nextview {

/// Inspects on a thread of its own, also while the session worker is busy: snapshots never change.
class InspectionWorker {
 public:
  /// `on_news` is called, from that thread, when there is another answer.
  explicit InspectionWorker(std::function<void()> on_news = {});
  ~InspectionWorker();
  InspectionWorker(const InspectionWorker&) = delete;
  InspectionWorker& operator=(const InspectionWorker&) = delete;

  /// Takes the place of what was asked and is not answered yet.
  void ask(std::shared_ptr<const SessionSnapshot> session, const Selection& selection);
  std::shared_ptr<const Inspection> answer() const;  ///< the latest; never null
  bool busy() const;

 private:
  struct Question {
    std::shared_ptr<const SessionSnapshot> session;
    Selection selection;
  };
  void run(std::stop_token stop);

  const std::function<void()> on_news_;
  Inspector inspector_;  ///< the thread's alone

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::optional<Question> question_;
  bool running_ = false;
  std::shared_ptr<const Inspection> answer_ = std::make_shared<Inspection>();

  std::jthread thread_;  ///< the last member: it ends before the others do
};

}  // namespace nextview
