#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "ui/workbench/session_log.hpp"
#include "ui/workbench/session_request.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {

/// Runs sessions on a thread of its own. Requests wait in a queue; every function returns at once, from any thread.
class SessionWorker {
 public:
  /// `on_news` is called, from other threads, when snapshot(), progress() or the log may have changed.
  explicit SessionWorker(std::function<void()> on_news = {});
  /// Cancels what runs and waits for it.
  ~SessionWorker();
  SessionWorker(const SessionWorker&) = delete;
  SessionWorker& operator=(const SessionWorker&) = delete;

  /// Sessions are kept below this folder (SessionRunner::keep_sessions). Before anything is posted.
  void keep_sessions(std::filesystem::path state);
  /// What starts a session anew takes the place of whatever runs or waits. Steps of a finished scan are ignored.
  void post(SessionRequest request);
  /// How many requests were posted: the number of the last one.
  std::uint64_t posted() const;
  /// What was done, in its order, and what was dropped before it was.
  struct Done {
    std::uint64_t request = 0;  ///< its number; 0: a view of request::Play
    bool failed = false;        ///< or dropped: nothing came of it
  };
  /// Since this was asked last.
  std::vector<Done> take_done();
  /// Drops what waits and stops what runs as soon as that is possible; a step that is not complete is taken back, a
  /// refinement keeps its sweeps so far.
  void cancel();
  /// Pauses a refinement between two sweeps, or resumes it.
  void pause_refinement(bool pause);
  /// Of the question whether to go on with a session, the first to do so.
  static const std::vector<std::string>& offer_answers();
  /// Answers the question that the job waits with (WorkerProgress::question), if that is the one of this number.
  void answer(const std::string& text, std::optional<std::uint64_t> number = {});
  /// Waits this long before each view but the first while playing [s].
  void set_pause_between_views(double seconds);

  std::shared_ptr<const SessionSnapshot> snapshot() const;  ///< never null
  WorkerProgress progress() const;
  SessionLog& log() { return log_; }

 private:
  using Clock = std::chrono::steady_clock;

  void run(std::stop_token stop);
  /// Waits for the next request; none if the worker is to end.
  std::optional<std::pair<std::uint64_t, SessionRequest>> next_request(std::stop_token stop);
  /// Does what was put off, while nothing is asked for.
  void catch_up(std::unique_lock<std::mutex>& lock);
  void execute(const SessionRequest& request);
  void change_setting(const request::ChangeSetting& wanted);
  void attempt(std::uint64_t number, const SessionRequest& request);
  void finish(const SessionRequest& request, const SessionSnapshot& before);
  void drop_all();  ///< of the queue and the job; the mutex must be held
  void report_progress(double fraction, std::string_view what);
  void report_sampler(const SamplerDiagnostics& so_far);
  SessionRunner::JobControl job_control();
  void show_meanwhile();
  std::string ask(std::string question, std::vector<std::string> answers,
                  std::shared_ptr<const DoubtfulScan> about = nullptr, std::vector<std::string> effects = {});
  void offer(const EarlierSession& session);
  Session::Verdict judge(const Acquired& acquired, const std::string& reason);
  ScannerWishes scanner_wishes(const request::Connect& request);
  void news() const;

  const std::function<void()> on_news_;
  SessionLog log_;
  SessionRunner runner_;  ///< the worker thread's alone

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::deque<std::pair<std::uint64_t, SessionRequest>> queue_;  ///< by number
  std::uint64_t posted_ = 0;
  std::vector<Done> done_;
  std::stop_source job_;
  Clock::time_point job_start_, next_play_;
  bool running_ = false;                ///< a request is being executed
  std::filesystem::path state_folder_;  ///< empty: nothing outlives this
  bool opening_ = false;                ///< it opens another session
  std::optional<std::string> answer_;
  WorkerProgress progress_;  ///< but for what progress() works out
  std::shared_ptr<const SessionSnapshot> snapshot_ = std::make_shared<SessionSnapshot>();

  std::jthread thread_;  ///< the last member: it ends before the others do
};

/// For the log: what a request that was cancelled leaves undone, and what is there.
std::string what_was_cancelled(const SessionRequest& request, const SessionSnapshot& before);

}  // namespace nextview
