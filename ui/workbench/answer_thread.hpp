#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace nextview {

/// Answers questions on a thread of its own. A question takes the place of the one before it, which is stopped if it is
/// under way.
template <class Question, class Answer>
class AnswerThread {
 public:
  /// May return null: there is no answer, and the one before stays. So it is where it throws, for lack of memory for
  /// example: nobody waits on that thread to hear of it.
  using Find = std::function<std::shared_ptr<const Answer>(const Question&, const std::stop_token&)>;

  /// `find` and `on_news` are called from that thread; the second when there is another answer.
  AnswerThread(Find find, std::function<void()> on_news)
      : find_(std::move(find)), on_news_(std::move(on_news)), thread_([this](std::stop_token end) { run(end); }) {}
  ~AnswerThread() {
    drop();
    thread_.request_stop();
    wake_.notify_all();
  }
  AnswerThread(const AnswerThread&) = delete;
  AnswerThread& operator=(const AnswerThread&) = delete;

  void ask(Question question) {
    {
      const std::lock_guard lock(mutex_);
      job_.request_stop();
      question_ = std::move(question);
    }
    wake_.notify_all();
  }
  /// Nobody wants to know any more.
  void drop() {
    const std::lock_guard lock(mutex_);
    job_.request_stop();
    question_.reset();
  }
  std::shared_ptr<const Answer> answer() const {  ///< the latest; never null
    const std::lock_guard lock(mutex_);
    return answer_;
  }
  bool busy() const {
    const std::lock_guard lock(mutex_);
    return running_ || question_;
  }

 private:
  void run(std::stop_token end) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, end, [&] { return question_.has_value(); })) {
      const Question question = *std::exchange(question_, std::nullopt);
      job_ = std::stop_source();
      const std::stop_token stop = job_.get_token();
      running_ = true;
      lock.unlock();
      auto answer = found(question, stop);
      lock.lock();
      running_ = false;
      if (answer) answer_ = std::move(answer);
      lock.unlock();
      if (on_news_) on_news_();
      lock.lock();
    }
  }

  std::shared_ptr<const Answer> found(const Question& question, const std::stop_token& stop) const {
    try {
      return find_(question, stop);
    } catch (const std::exception&) {
      return nullptr;
    }
  }

  const Find find_;
  const std::function<void()> on_news_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::optional<Question> question_;
  std::stop_source job_;  ///< of the question that is under way
  bool running_ = false;
  std::shared_ptr<const Answer> answer_ = std::make_shared<Answer>();

  std::jthread thread_;  ///< the last member: it ends before the others do
};

}  // namespace nextview
