#include "ui/workbench/inspection_worker.hpp"

#include <utility>

namespace nextview {

InspectionWorker::InspectionWorker(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this](std::stop_token stop) { run(stop); }) {}

InspectionWorker::~InspectionWorker() {
  thread_.request_stop();
  wake_.notify_all();
}

void InspectionWorker::ask(std::shared_ptr<const SessionSnapshot> session, const Selection& selection) {
  {
    const std::lock_guard lock(mutex_);
    question_ = Question{std::move(session), selection};
  }
  wake_.notify_all();
}

std::shared_ptr<const Inspection> InspectionWorker::answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

bool InspectionWorker::busy() const {
  const std::lock_guard lock(mutex_);
  return running_ || question_;
}

void InspectionWorker::run(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return question_.has_value(); })) {
    const Question question = *std::exchange(question_, std::nullopt);
    running_ = true;
    lock.unlock();
    auto answer = std::make_shared<const Inspection>(inspector_.inspect(question.session, question.selection));
    lock.lock();
    running_ = false;
    answer_ = std::move(answer);
    lock.unlock();
    if (on_news_) on_news_();
    lock.lock();
  }
}

}  // namespace nextview
