#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "core/session/session.hpp"
#include "ui/window/session_command.hpp"
#include "ui/window/session_snapshot.hpp"

namespace nextview {

/// Runs a session on a thread of its own. Commands wait in a queue; every function returns at once, from any thread.
class SessionWorker {
 public:
  /// `on_news` is called, from other threads, when snapshot() or progress() may have changed.
  explicit SessionWorker(std::function<void()> on_news = {});
  /// Cancels what runs and waits for it.
  ~SessionWorker();
  SessionWorker(const SessionWorker&) = delete;
  SessionWorker& operator=(const SessionWorker&) = delete;

  /// What starts a session anew takes the place of whatever runs or waits. Steps of a finished scan are ignored.
  void post(SessionCommand command);
  /// Drops what waits and stops what runs as soon as that is possible; a step that has entered the map is completed.
  void cancel();

  std::shared_ptr<const SessionSnapshot> snapshot() const;  ///< never null
  WorkerProgress progress() const;

 private:
  void run(std::stop_token stop);
  /// Waits for the next command; none if the worker is to end.
  std::optional<SessionCommand> next_command(std::stop_token stop);
  void execute(const SessionCommand& command);
  void load(Configuration configuration);
  void step();
  void drop_all();  ///< of the queue and the job; the mutex must be held
  void tell(double fraction, std::string_view what);
  void publish(SessionSnapshot snapshot);
  void publish_message(const std::string& message);

  const std::function<void()> on_news_;
  std::unique_ptr<Session> session_;  ///< the worker thread's alone
  PointCloud cloud_;                  ///< so is this

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::deque<SessionCommand> queue_;
  std::stop_source job_;
  bool running_ = false;     ///< a command is being executed
  WorkerProgress progress_;  ///< but for what progress() works out
  std::shared_ptr<const SessionSnapshot> snapshot_ = std::make_shared<SessionSnapshot>();

  std::jthread thread_;  ///< the last member: it ends before the others do
};

}  // namespace nextview
