#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>

namespace nextview {

/// A child of this process, and the end of a pipe that it fills. It is ended, and waited for, with this object.
///
/// Forking is safe here though other threads run: the C library sees to its own locks (memory, streams, loader), the
/// child uses nothing else of this program that locks, and should it wait for ever all the same, its time ends it.
class ReadingProcess {
 public:
  struct TooSlow : std::runtime_error {
    TooSlow() : std::runtime_error("too slow") {}
  };

  /// @param run what the child does; told the end of the pipe to write into. It must not return.
  /// @param time for all that is received [ms]
  /// @throws std::system_error if there can be no process
  ReadingProcess(const std::function<void(int pipe)>& run, std::chrono::milliseconds time, std::stop_token stop);
  ~ReadingProcess();
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;

  /// @return whether so many bytes came before the child ended
  /// @throws TooSlow, Stopped
  bool receive(void* data, std::size_t size);
  struct Death {
    std::string reason;             ///< for people
    std::uint64_t peak_memory = 0;  ///< resident at once, beyond what it had at its start, give or take [bytes]
  };
  /// Ends it, if it has not ended by itself.
  Death end();

 private:
  pid_t process_ = -1;
  int pipe_ = -1;
  bool closed_ = false;  ///< by the child
  std::chrono::steady_clock::time_point deadline_;
  std::stop_token stop_;
  std::uint64_t memory_at_start_;  ///< [bytes]
};

}  // namespace nextview
