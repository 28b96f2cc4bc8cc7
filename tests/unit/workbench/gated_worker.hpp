#pragma once
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "tests/unit/workbench/small_scan.hpp"
#include "ui/workbench/session_worker.hpp"

namespace nextview {

/// A worker that a test holds at a point of a job, so that what waits behind it is known.
class GatedWorker : public testing::Test {
 protected:
  ~GatedWorker() override { open_gate(); }

  /// The worker's thread stops when it says that it is at this.
  void close_gate(const std::string& at) {
    const std::lock_guard lock(mutex_);
    gate_ = at;
    held_ = false;
  }
  void wait_at_gate() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return held_; });
  }
  void open_gate() {
    {
      const std::lock_guard lock(mutex_);
      gate_.clear();
    }
    changed_.notify_all();
  }
  void wait_until_idle() {
    std::unique_lock lock(mutex_);
    while (worker_.progress().busy) changed_.wait_for(lock, std::chrono::milliseconds(10));
  }
  void load(const Configuration& configuration = small_scan()) {
    worker_.post(request::Load{configuration});
    wait_until_idle();
  }
  void step() {
    worker_.post(request::Step{});
    wait_until_idle();
  }
  /// Takes a view that is held before it measures anything.
  void begin_step() {
    close_gate("taking the view");
    worker_.post(request::Step{});
    wait_at_gate();
  }
  std::shared_ptr<const SessionSnapshot> now() { return worker_.snapshot(); }
  std::vector<std::string> log() {
    std::vector<std::string> texts;
    for (const LogEntry& entry : *worker_.log().entries()) texts.push_back(entry.text);
    return texts;
  }
  LogEntry last_entry() { return worker_.log().entries()->back(); }

 private:
  void on_news() {
    if (std::this_thread::get_id() == test_) return changed_.notify_all();
    const std::string at = worker_.progress().what;
    std::unique_lock lock(mutex_);
    if (!gate_.empty() && at == gate_) {
      held_ = true;
      changed_.notify_all();
      changed_.wait(lock, [&] { return gate_.empty(); });
    }
    changed_.notify_all();
  }

  const std::thread::id test_ = std::this_thread::get_id();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string gate_;
  bool held_ = false;

 protected:
  SessionWorker worker_{[this] { on_news(); }};
};

}  // namespace nextview
