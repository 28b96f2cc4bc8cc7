#include "app/commands/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

namespace nextview {
namespace {

std::atomic<bool> interrupted = false;

}  // namespace

StopOnInterrupt::StopOnInterrupt() : previous_(std::signal(SIGINT, [](int) { interrupted = true; })) {
  watcher_ = std::jthread([this](std::stop_token done) {
    while (!done.stop_requested() && !interrupted) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (interrupted) source_.request_stop();
  });
}

StopOnInterrupt::~StopOnInterrupt() { std::signal(SIGINT, previous_); }

ProgressLine::ProgressLine() : visible_(::isatty(STDERR_FILENO)) {}

void ProgressLine::operator()(double fraction, std::string_view what) const {
  if (visible_) fmt::print(stderr, "\r\033[K{:3.0f} %  {}", 100.0 * fraction, what);
}

void ProgressLine::clear() const {
  if (visible_) fmt::print(stderr, "\r\033[K");
}

}  // namespace nextview
