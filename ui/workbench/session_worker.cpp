#include "ui/workbench/session_worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "core/file/counted.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/seconds_left.hpp"
#include "core/progress/stopped.hpp"
#include "ui/workbench/overloaded.hpp"
#include "ui/workbench/request_kind.hpp"

namespace nextview {
namespace {

/// Smaller steps of progress are no news.
constexpr double min_progress = 0.01;

/// "The surface of the Gibbs map of 4 views: written to "
std::string what_is_written(const request::ExportOne& wanted) {
  if (!wanted.gibbs) return "Written to ";
  return fmt::format("The {}Gibbs map of {}: written to ", wanted.kind == ExportKind::surface ? "surface of the " : "",
                     counted(wanted.gibbs->views, "view"));
}

}  // namespace

SessionWorker::SessionWorker(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this](std::stop_token stop) { run(stop); }) {}

SessionWorker::~SessionWorker() {
  thread_.request_stop();  // first: what it begins after a cancel would not hear of that
  cancel();
}

void SessionWorker::news() const {
  if (on_news_) on_news_();
}

void SessionWorker::keep_sessions(std::filesystem::path state) {
  state_folder_ = state;
  runner_.keep_sessions(std::move(state),
                        [this](const std::string& line) { log_.add(LogEntry::Level::warning, line); });
}

std::shared_ptr<const SessionSnapshot> SessionWorker::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

WorkerProgress SessionWorker::progress() const {
  const std::lock_guard lock(mutex_);
  WorkerProgress progress = progress_;
  progress.busy = running_ || progress_.playing || !queue_.empty();
  progress.waiting = queue_.size();
  progress.cancelling = running_ && job_.stop_requested();
  const auto opens = [](const auto& waiting) { return opens_another(waiting.second); };
  progress.opening = (running_ && opening_) || std::ranges::any_of(queue_, opens);
  const double elapsed = std::chrono::duration<double>(Clock::now() - job_start_).count();
  if (running_ && !progress.cancelling && !progress.paused)
    progress.seconds_left = seconds_left(progress.fraction, elapsed);
  return progress;
}

void SessionWorker::drop_all() {
  for (const auto& [number, request] : queue_) done_.push_back({number, true});  // who wrote it down hears of it
  queue_.clear();
  progress_.playing = progress_.paused = false;
  job_.request_stop();
}

void SessionWorker::cancel() {
  {
    const std::lock_guard lock(mutex_);
    drop_all();
  }
  wake_.notify_all();
  news();
}

void SessionWorker::pause_refinement(bool pause) {
  {
    const std::lock_guard lock(mutex_);
    progress_.paused = pause && progress_.refining;
  }
  wake_.notify_all();
  news();
}

void SessionWorker::set_pause_between_views(double seconds) {
  {
    const std::lock_guard lock(mutex_);
    progress_.pause_between_views = std::max(seconds, 0.0);
    next_play_ = Clock::now();
  }
  wake_.notify_all();
  news();
}

void SessionWorker::post(SessionRequest request) {
  {
    const std::lock_guard lock(mutex_);
    ++posted_;
    if (starts_anew(request)) drop_all();
    if (is<request::Pause>(request)) {
      progress_.playing = false;
      std::erase_if(queue_, [](const auto& waiting) { return is<request::Play>(waiting.second); });
    } else {
      // Of going along only the last place counts; what was asked for in between is done where it was asked for.
      if (is<request::GoTo>(request) && !queue_.empty() && is<request::GoTo>(queue_.back().second)) queue_.pop_back();
      queue_.emplace_back(posted_, std::move(request));
    }
  }
  wake_.notify_all();
  news();
}

std::uint64_t SessionWorker::posted() const {
  const std::lock_guard lock(mutex_);
  return posted_;
}

std::vector<SessionWorker::Done> SessionWorker::take_done() {
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, {});
}

std::optional<std::pair<std::uint64_t, SessionRequest>> SessionWorker::next_request(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stop.stop_requested()) return std::nullopt;
    catch_up(lock);
    wake_.wait(lock, stop, [&] { return !queue_.empty() || progress_.playing; });
    if (stop.stop_requested()) return std::nullopt;
    if (!queue_.empty() || next_play_ <= Clock::now()) break;
    wake_.wait_until(lock, stop, next_play_, [&] { return !queue_.empty() || !progress_.playing; });
  }
  job_ = std::stop_source();
  job_start_ = Clock::now();
  running_ = true;
  opening_ = !queue_.empty() && opens_another(queue_.front().second);
  if (queue_.empty()) return std::pair<std::uint64_t, SessionRequest>(0, request::Step{});
  auto request = std::move(queue_.front());
  queue_.pop_front();
  return request;
}

void SessionWorker::catch_up(std::unique_lock<std::mutex>& lock) {
  job_ = std::stop_source();
  const std::stop_token stop = job_.get_token();
  while (queue_.empty() && !progress_.playing && !stop.stop_requested() && runner_.is_behind()) {
    lock.unlock();
    try {
      runner_.catch_up(stop);
    } catch (const std::exception&) {  // who goes there does it again, and hears of it
    }
    lock.lock();
  }
}

void SessionWorker::run(std::stop_token stop) {
  while (const auto request = next_request(stop)) {
    attempt(request->first, request->second);
    {
      const std::lock_guard lock(mutex_);
      running_ = progress_.refining = progress_.paused = false;
      progress_.fraction = 0.0;
      progress_.what.clear();
      progress_.sampler = nullptr;
      const std::chrono::duration<double> pause(progress_.pause_between_views);
      next_play_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
    }
    news();
    if (is<request::Load>(request->second) || is<request::OpenFile>(request->second)) return_freed_memory();
  }
}

/// Executes a request and publishes what came of it, also if it failed.
void SessionWorker::attempt(std::uint64_t number, const SessionRequest& request) {
  const auto before = runner_.snapshot();
  bool failed = false;
  try {
    execute(request);
  } catch (const std::exception& error) {
    failed = true;
    const bool cancelled = [&] {
      const std::lock_guard lock(mutex_);
      return job_.stop_requested();
    }();
    if (!cancelled) runner_.set_message(error.what());
    if (cancelled) log_.add(LogEntry::Level::note, what_was_cancelled(request, *before));
    if (!cancelled) log_.add(LogEntry::Level::warning, error.what());
  }
  const auto after = runner_.snapshot();
  if (!failed) finish(request, *before);
  const std::lock_guard lock(mutex_);
  const bool taken = after->records.size() > before->records.size();
  const bool came_to_nothing = failed || (is<request::Step>(request) && !taken);  // a cancelled step does not fail
  if (number > 0 || taken) done_.push_back({number, came_to_nothing});
  if (came_to_nothing || !runner_.can_step()) progress_.playing = false;
  snapshot_ = after;
}

void SessionWorker::execute(const SessionRequest& request) {
  std::visit(Overloaded{
                 [&](const request::Load& r) { runner_.load(r.configuration, job_control()); },
                 [&](const request::OpenFile& r) { runner_.open(r.file, job_control()); },
                 [&](const request::OfferSession& r) { offer(r.session); },
                 [&](const request::Connect& r) { runner_.connect(scanner_wishes(r), r.configuration, job_control()); },
                 [&](request::Disconnect) { runner_.disconnect(job_control()); },
                 [&](request::Reconnect) {
                   runner_.reconnect(job_control());
                   log_.add(LogEntry::Level::success, "The scanner is reached again");
                 },
                 [&](const request::SetTermination& r) { runner_.set_termination(r.termination); },
                 [&](const request::ChangeSetting& r) { change_setting(r); },
                 [&](request::Reset) { runner_.load(runner_.configuration(), job_control()); },
                 [&](const request::Step& r) {
                   runner_.step(
                       job_control(),
                       [this](const auto& acquired, const auto& reason) { return judge(acquired, reason); },
                       r.with_last);
                 },
                 [&](request::Play) {
                   const std::lock_guard lock(mutex_);
                   progress_.playing = runner_.can_step();
                   next_play_ = Clock::now();
                 },
                 [](request::Pause) {},  // done when it was posted
                 [&](const request::TakeView& r) { runner_.take_view(r.candidate); },
                 [&](const request::TakeCustomView& r) { runner_.take_custom_view(r.T_world_camera); },
                 [&](request::Undo) { runner_.undo(job_control()); },
                 [&](request::Redo) { runner_.redo(job_control()); },
                 [&](const request::GoTo& r) {
                   {
                     const std::lock_guard lock(mutex_);
                     progress_.playing = false;
                   }
                   runner_.go_to(r.branch, r.views, job_control());
                 },
                 [&](const request::BeginBranch& r) { runner_.begin_branch(r.name); },
                 [&](const request::KeepCamera& r) { runner_.keep_camera(r.camera); },
                 [&](const request::RemoveCamera& r) { runner_.remove_camera(r.name); },
                 [&](const request::RenameBranch& r) { runner_.rename_branch(r.name, r.to); },
                 [&](const request::RemoveBranch& r) { runner_.remove_branch(r.name); },
                 [&](const request::Compare& r) { runner_.compare(r.branch, job_control(), r.view_for_view); },
                 [&](const request::Refine& r) {
                   {
                     const std::lock_guard lock(mutex_);
                     progress_.refining = true;
                   }
                   runner_.refine(r.chains, r.sweeps, job_control());
                 },
                 [&](const request::Export& r) {
                   for (const std::string& line : runner_.write(r.folder, job_control()))
                     log_.add(LogEntry::Level::note, line);
                 },
                 [&](const request::ExportOne& r) {
                   for (const auto& file : runner_.write_one(r, job_control()))
                     log_.add(LogEntry::Level::success, what_is_written(r) + file.string());
                 },
                 [&](request::ForgetRuns) { runner_.forget_runs(); },
             },
             request);
}

void SessionWorker::change_setting(const request::ChangeSetting& wanted) {
  Configuration configuration = runner_.configuration();
  auto all = settings(configuration);
  Setting& setting = find_setting(all, wanted.key);
  if (setting.text() == wanted.text) return;
  setting.set(wanted.text);
  if (wanted.key.starts_with("termination.")) return runner_.set_termination(configuration.termination);
  runner_.set_planning(planning_of(configuration), job_control());
}

SessionRunner::JobControl SessionWorker::job_control() {
  const std::lock_guard lock(mutex_);
  return {[this](double fraction, std::string_view what) { report_progress(fraction, what); },
          [this](const SamplerDiagnostics& so_far) { report_sampler(so_far); }, job_.get_token(),
          [this] { show_meanwhile(); }};
}

void SessionWorker::show_meanwhile() {
  {
    const std::lock_guard lock(mutex_);
    snapshot_ = runner_.snapshot();
  }
  news();
}

void SessionWorker::report_progress(double fraction, std::string_view what) {
  {
    const std::lock_guard lock(mutex_);
    if (progress_.what == what && std::abs(fraction - progress_.fraction) < min_progress) return;
    progress_.fraction = fraction;
    progress_.what = what;
  }
  news();
}

void SessionWorker::report_sampler(const SamplerDiagnostics& so_far) {
  auto copy = std::make_shared<const SamplerDiagnostics>(so_far);
  std::unique_lock lock(mutex_);
  progress_.sampler = std::move(copy);
  lock.unlock();
  news();
  lock.lock();
  wake_.wait(lock, job_.get_token(), [&] { return !progress_.paused; });
}

}  // namespace nextview
