#include "core/driver/error_stream.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

#include "core/file/printable.hpp"

namespace nextview {
namespace {

constexpr int poll_interval = 50;           // for the end [ms]
constexpr std::size_t longest_line = 4096;  // longer ones are broken
constexpr std::size_t read_at_once = 4096;
constexpr int most_at_end = 16;  // reads of what a full pipe holds
/// A program that has ended may have children that keep its standard error open.
constexpr auto last_words_wait = std::chrono::milliseconds(200);

}  // namespace

ErrorStream::ErrorStream(Descriptor pipe, std::function<void(const std::string&)> log)
    : pipe_(std::move(pipe)), log_(std::move(log)) {
  ::fcntl(pipe_.get(), F_SETFL, O_NONBLOCK);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

ErrorStream::~ErrorStream() {
  thread_.request_stop();
  thread_.join();
}

std::string ErrorStream::last_line() {
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, last_words_wait, [&] { return at_end_; });
  return last_;
}

void ErrorStream::run(const std::stop_token& stop) {
  for (int left = most_at_end; left > 0;) {
    pollfd waiting = {pipe_.get(), POLLIN, 0};
    const bool stopping = stop.stop_requested();
    const int ready = ::poll(&waiting, 1, stopping ? 0 : poll_interval);
    left -= stopping;
    if (ready > 0 ? !read_some() : stopping) break;
  }
  if (!line_.empty()) say();
  const std::lock_guard lock(mutex_);
  at_end_ = true;
  ended_.notify_all();
}

bool ErrorStream::read_some() {
  std::array<char, read_at_once> bytes;
  const ssize_t got = ::read(pipe_.get(), bytes.data(), bytes.size());
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  take({bytes.data(), static_cast<std::size_t>(got)});
  return got > 0;
}

void ErrorStream::take(std::string_view bytes) {
  for (const char byte : bytes) {
    if (byte != '\n') line_ += byte;
    if (byte == '\n' || line_.size() == longest_line) say();
  }
}

void ErrorStream::say() {
  const std::string text = printable(std::exchange(line_, {}));
  if (text.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    last_ = text;
  }
  if (!log_) return;
  try {
    log_(text);
  } catch (...) {  // who only listens does not end the program
  }
}

}  // namespace nextview
