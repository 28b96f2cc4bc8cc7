#include "app/commands/progress.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>

#include "app/commands/commands.hpp"

namespace nextview {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers take no locks");

using Handler = void (*)(int);

/// Returns what handled the signal before. What is ignored stays ignored.
struct sigaction handle(int signal, Handler handler) {
  struct sigaction previous {
  }, next{};
  next.sa_handler = handler;
  next.sa_flags = SA_RESTART;
  ::sigaction(signal, nullptr, &previous);
  if (previous.sa_handler != SIG_IGN) ::sigaction(signal, &next, nullptr);
  return previous;
}

/// Only what is allowed in a signal handler.
void end_at_once(int) {
  constexpr std::string_view line = "nextview: stopped\n", over_progress = "\r\033[K";
  if (::isatty(STDERR_FILENO)) [[maybe_unused]]
    const auto cleared = ::write(STDERR_FILENO, over_progress.data(), over_progress.size());
  [[maybe_unused]] const auto told = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(exit_stopped);
}

void ask_to_stop(int) {
  interrupted = true;
  for (const int signal : stop_signals) handle(signal, end_at_once);
}

}  // namespace

void end_on_interrupt() {
  for (const int signal : stop_signals) handle(signal, end_at_once);
}

StopOnInterrupt::StopOnInterrupt() {
  for (std::size_t i = 0; i < stop_signals.size(); ++i) previous_[i] = handle(stop_signals[i], ask_to_stop);
  watcher_ = std::jthread([this](std::stop_token done) {
    while (!done.stop_requested() && !interrupted) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (interrupted) source_.request_stop();
  });
}

bool StopOnInterrupt::asked() const { return interrupted; }

StopOnInterrupt::~StopOnInterrupt() {
  for (std::size_t i = 0; i < stop_signals.size(); ++i) ::sigaction(stop_signals[i], &previous_[i], nullptr);
}

void flush_output() {
  if (std::fflush(stdout) == 0 || errno != EPIPE) return;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {  // `2>&1 | head -3` has both end there
    pollfd reader{stream, 0, 0};
    if (::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) != 0) ::dup2(nowhere, stream);
  }
  ::close(nowhere);
  std::clearerr(stdout);
}

ProgressLine::ProgressLine() : visible_(::isatty(STDERR_FILENO)) {}

void ProgressLine::operator()(double fraction, std::string_view what) const {
  if (visible_) fmt::print(stderr, "\r\033[K{:3.0f} %  {}", 100.0 * fraction, what);
}

void ProgressLine::clear() const {
  if (visible_) fmt::print(stderr, "\r\033[K");
}

}  // namespace nextview
