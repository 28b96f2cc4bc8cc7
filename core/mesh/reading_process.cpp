#include "core/mesh/reading_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/mesh/confinement.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr int look_every = 50;  // for a stop and for the time [ms]

}  // namespace

ReadingProcess::ReadingProcess(const std::function<void(int pipe)>& run, std::chrono::milliseconds time,
                               std::stop_token stop)
    : deadline_(std::chrono::steady_clock::now() + time),
      stop_(std::move(stop)),
      memory_at_start_(held_memory().resident) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot start its reader");
  process_ = ::fork();
  const int error = errno;
  if (process_ == 0) {
    run(ends[1]);
    ::_exit(1);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
  if (process_ > 0) return;
  ::close(pipe_);
  throw std::system_error(error, std::generic_category(), "cannot start its reader");
}

ReadingProcess::~ReadingProcess() {
  end();
  ::close(pipe_);
}

bool ReadingProcess::receive(void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    throw_if_stopped(stop_);
    if (std::chrono::steady_clock::now() > deadline_) throw TooSlow();
    pollfd waiting = {pipe_, POLLIN, 0};
    if (::poll(&waiting, 1, look_every) <= 0) continue;
    const ssize_t received = ::read(pipe_, bytes, size);
    if (received < 0 && errno == EINTR) continue;
    closed_ = received <= 0;
    if (closed_) return false;
    bytes += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}

ReadingProcess::Death ReadingProcess::end() {
  if (process_ < 0) return {};
  ::kill(process_, SIGKILL);
  int status = 0;
  rusage used{};
  while (::wait4(process_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  process_ = -1;
  const auto most = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  Death death{"no result", most - std::min(most, memory_at_start_)};
  if (closed_ && WIFSIGNALED(status))
    death.reason = WTERMSIG(status) == SIGKILL ? "killed, perhaps for want of memory" : ::strsignal(WTERMSIG(status));
  return death;
}

}  // namespace nextview
