#include "ui/window/session_worker.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "ui/window/known_objects.hpp"

namespace nextview {
namespace {

/// Smaller steps of progress are no news.
constexpr double least_progress = 0.01;

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

bool starts_anew(const SessionCommand& command) {
  return std::holds_alternative<command::Load>(command) || std::holds_alternative<command::OpenFile>(command) ||
         std::holds_alternative<command::Reset>(command);
}

Configuration with_file(Configuration configuration, const std::filesystem::path& file) {
  if (file.extension() == ".toml") return read_configuration(file, configuration);
  configuration.object.file = file.string();
  return configuration;
}

void add_next_view(SessionSnapshot& snapshot, const Session& session) {
  snapshot.next_candidate = session.next_candidate();
  snapshot.next_view = session.next_view();
  snapshot.explanation = nullptr;
  if (!snapshot.next_candidate) return;
  if (auto explanation = session.explain(*snapshot.next_candidate)) {
    snapshot.explanation = std::make_shared<const ScoreExplanation>(std::move(*explanation));
  }
}

void add_map(SessionSnapshot& snapshot, const Session& session, const PointCloud& cloud) {
  const auto voxels = session.planning_voxels();
  ++snapshot.map;
  snapshot.voxels = std::make_shared<const std::vector<Voxel>>(voxels.begin(), voxels.end());
  snapshot.cloud = std::make_shared<const PointCloud>(cloud);
  snapshot.records = session.records();
  snapshot.finished = session.finished();
}

}  // namespace

SessionWorker::SessionWorker(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this](std::stop_token stop) { run(stop); }) {}

SessionWorker::~SessionWorker() { cancel(); }

std::shared_ptr<const SessionSnapshot> SessionWorker::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

WorkerProgress SessionWorker::progress() const {
  const std::lock_guard lock(mutex_);
  WorkerProgress progress = progress_;
  progress.busy = running_ || progress_.playing || !queue_.empty();
  progress.waiting = queue_.size();
  return progress;
}

void SessionWorker::drop_all() {
  queue_.clear();
  progress_.playing = false;
  job_.request_stop();
}

void SessionWorker::cancel() {
  {
    const std::lock_guard lock(mutex_);
    drop_all();
  }
  if (on_news_) on_news_();
}

void SessionWorker::post(SessionCommand command) {
  {
    const std::lock_guard lock(mutex_);
    if (starts_anew(command)) drop_all();
    if (std::holds_alternative<command::Pause>(command)) {
      progress_.playing = false;
      std::erase_if(queue_, [](const auto& waiting) { return std::holds_alternative<command::Play>(waiting); });
    } else {
      queue_.push_back(std::move(command));
    }
  }
  wake_.notify_all();
  if (on_news_) on_news_();
}

std::optional<SessionCommand> SessionWorker::next_command(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, stop, [&] { return !queue_.empty() || progress_.playing; });
  if (stop.stop_requested()) return std::nullopt;
  job_ = std::stop_source();
  running_ = true;
  if (queue_.empty()) return command::Step{};
  SessionCommand command = std::move(queue_.front());
  queue_.pop_front();
  return command;
}

void SessionWorker::run(std::stop_token stop) {
  while (const auto command = next_command(stop)) {
    try {
      execute(*command);
    } catch (const std::exception& error) {
      const bool cancelled = [&] {
        const std::lock_guard lock(mutex_);
        return job_.stop_requested();
      }();
      publish_message(cancelled ? "" : error.what());
    }
    {
      const std::lock_guard lock(mutex_);
      running_ = false;
      progress_.fraction = 0.0;
      progress_.what.clear();
    }
    if (on_news_) on_news_();
  }
}

void SessionWorker::execute(const SessionCommand& command) {
  const Configuration current = session_ ? session_->configuration() : Configuration{};
  std::visit(Overloaded{
                 [&](const command::Load& c) { load(c.configuration); },
                 [&](const command::OpenFile& c) { load(with_file(current, c.file)); },
                 [&](command::Reset) { load(current); },
                 [&](command::Step) { step(); },
                 [&](command::Play) {
                   const std::lock_guard lock(mutex_);
                   progress_.playing = session_ && session_->finished().empty();
                 },
                 [](command::Pause) {},  // done when it was posted
                 [&](const command::TakeView& c) {
                   if (!session_) return;
                   session_->override_next_view(c.candidate);
                   SessionSnapshot next = *snapshot();
                   add_next_view(next, *session_);
                   publish(std::move(next));
                 },
             },
             command);
}

void SessionWorker::load(Configuration configuration) {
  tell(0.0, "loading the object");
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    stop = job_.get_token();
  }
  const auto progress = [this](double fraction, std::string_view what) { tell(fraction, what); };
  // The session before stays if this one cannot be made.
  session_ = std::make_unique<Session>(std::move(configuration), progress, stop);
  cloud_.clear();

  SessionSnapshot next = *snapshot();
  ++next.session;
  next.configuration = session_->configuration();
  next.object_name = object_name(session_->object_file());
  next.mesh = session_->mesh();
  next.grid = session_->map().grid();
  next.camera = session_->camera().camera();
  next.candidates = session_->candidates();
  next.gain_unit = gain_unit(next.configuration.planner.gain);
  add_map(next, *session_, cloud_);
  add_next_view(next, *session_);
  publish(std::move(next));
}

void SessionWorker::step() {
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    if (!session_ || !session_->finished().empty()) {
      progress_.playing = false;
      return;
    }
    stop = job_.get_token();
  }
  const auto progress = [this](double fraction, std::string_view what) { tell(fraction, what); };
  if (!session_->step(progress, stop)) return;
  const PointCloud& points = session_->scans().back()->returns;
  cloud_.insert(cloud_.end(), points.begin(), points.end());

  SessionSnapshot next = *snapshot();
  add_map(next, *session_, cloud_);
  add_next_view(next, *session_);
  const std::lock_guard lock(mutex_);
  if (!next.finished.empty()) progress_.playing = false;
  next.message.clear();
  snapshot_ = std::make_shared<const SessionSnapshot>(std::move(next));
}

void SessionWorker::tell(double fraction, std::string_view what) {
  {
    const std::lock_guard lock(mutex_);
    if (progress_.what == what && std::abs(fraction - progress_.fraction) < least_progress) return;
    progress_.fraction = fraction;
    progress_.what = what;
  }
  if (on_news_) on_news_();
}

void SessionWorker::publish(SessionSnapshot snapshot) {
  snapshot.message.clear();
  auto published = std::make_shared<const SessionSnapshot>(std::move(snapshot));
  const std::lock_guard lock(mutex_);
  snapshot_ = std::move(published);
}

void SessionWorker::publish_message(const std::string& message) {
  SessionSnapshot next = *snapshot();
  next.message = message;
  auto published = std::make_shared<const SessionSnapshot>(std::move(next));
  const std::lock_guard lock(mutex_);
  snapshot_ = std::move(published);
  progress_.playing = false;
}

}  // namespace nextview
