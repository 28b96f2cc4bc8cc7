#include "core/driver/driver_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/driver/started_process.hpp"

namespace nextview {
namespace {

constexpr auto look_every = std::chrono::milliseconds(50);  // for a stop
constexpr double patience = 0.2;                            // for a program that closed its streams to end [s]

/// While it lives, to write to a pipe without a reader is an error of this thread and no signal of the process.
class WithoutPipeSignal {
 public:
  WithoutPipeSignal() {
    sigset_t pending;
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    ::sigpending(&pending);
    pending_before_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutPipeSignal() {
    const timespec at_once{};
    while (!pending_before_ && ::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutPipeSignal(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool pending_before_;
};

}  // namespace

DriverProcess::DriverProcess(const std::vector<std::string>& words, std::function<void(const std::string&)> log,
                             double grace)
    : grace_(grace) {
  StartedProcess started = start_process(words);
  process_ = started.process;
  to_ = std::move(started.input);
  from_ = std::move(started.output);
  for (const Descriptor* end : {&to_, &from_}) ::fcntl(end->get(), F_SETFL, O_NONBLOCK);
  try {
    errors_ = std::make_unique<ErrorStream>(std::move(started.errors), std::move(log));
  } catch (...) {  // there can be no more threads
    end();
    throw;
  }
}

DriverProcess::~DriverProcess() { end(); }

void DriverProcess::send(std::string_view line) {
  sending_.append(line) += '\n';
  write_some();
}

DriverProcess::Received DriverProcess::receive(std::string& line, const std::optional<Clock::time_point>& deadline,
                                               const std::stop_token& stop) {
  for (;;) {
    if (stop.stop_requested()) return Received::stopped;
    if (take_line(line)) return Received::line;
    if (received_.size() > longest_line) return Received::too_long;
    if (closed_) return Received::closed;
    if (deadline && Clock::now() >= *deadline) return Received::timed_out;
    wait(deadline);
  }
}

bool DriverProcess::take_line(std::string& line) {
  const std::size_t end = received_.find('\n', searched_);
  searched_ = received_.size();
  if (end == received_.npos || end > longest_line) return false;
  line.assign(received_, 0, end);
  received_.erase(0, end + 1);
  searched_ = 0;
  return true;
}

/// Until something comes or goes, or a stop should be looked for.
void DriverProcess::wait(const std::optional<Clock::time_point>& deadline) {
  auto time = std::chrono::duration_cast<Clock::duration>(look_every);
  if (deadline) time = std::clamp(*deadline - Clock::now(), Clock::duration::zero(), time);
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(time).count();
  std::array<pollfd, 2> ends = {pollfd{from_.get(), POLLIN, 0}, {sending_.empty() ? -1 : to_.get(), POLLOUT, 0}};
  const int ready = ::poll(ends.data(), ends.size(), static_cast<int>(milliseconds));
  if (ready > 0 && ends[1].revents) write_some();
  if (ready > 0 && ends[0].revents)
    read_some();
  else if (deaf_)
    closed_ = true;  // who does not listen does not answer; what it had said before has come
}

void DriverProcess::write_some() {
  const WithoutPipeSignal none;
  while (!sending_.empty() && to_.is_open() && !deaf_) {
    const ssize_t sent = ::write(to_.get(), sending_.data(), sending_.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && errno == EAGAIN) return;
    deaf_ = sent < 0;
    sending_.erase(0, deaf_ ? sending_.size() : static_cast<std::size_t>(sent));
  }
}

void DriverProcess::read_some() {
  std::array<char, 1 << 16> bytes;
  const ssize_t got = ::read(from_.get(), bytes.data(), bytes.size());
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return;
  closed_ = got <= 0;
  if (!closed_) received_.append(bytes.data(), static_cast<std::size_t>(got));
}

/// It is not reaped: as long as it is a zombie, nothing else gets its number.
bool DriverProcess::ends_within(double seconds) const {
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  for (int pause = 1;; pause = std::min(2 * pause, 10)) {
    siginfo_t ended{};
    const int error = ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == process_ || (error != 0 && errno != EINTR)) return true;
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(pause));
  }
}

std::string DriverProcess::end_reason() {
  if (has_ended()) return "it was ended";
  if (!ends_within(patience)) return deaf_ ? "it closed its standard input" : "it closed its standard output";
  siginfo_t ended{};
  ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
  std::string reason = ended.si_code == CLD_EXITED ? fmt::format("it ended with exit code {}", ended.si_status)
                                                   : fmt::format("it was killed by signal {} ({})", ended.si_status,
                                                                 ::strsignal(ended.si_status));
  if (const std::string last = errors_->last_line(); !last.empty()) reason += fmt::format("; it last said: {}", last);
  return reason;
}

void DriverProcess::end(std::string_view farewell) {
  if (has_ended()) return;
  if (!farewell.empty()) send(farewell);
  to_.close();
  if (!ends_within(grace_)) {
    ::kill(-process_, SIGTERM);
    ends_within(std::min(grace_, 0.5));
  }
  ::kill(-process_, SIGKILL);  // it, or what it has started and left behind
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  closed_ = true;
  from_.close();
  errors_.reset();
}

}  // namespace nextview
