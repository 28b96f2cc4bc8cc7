#pragma once
#include <sys/types.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/driver/error_stream.hpp"
#include "core/file/descriptor.hpp"

namespace nextview {

/// A program that reads lines and answers with lines. It runs in a process group of its own, which ends with this
/// object, and inherits nothing but its three standard streams.
class DriverProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param words the program, looked for on the PATH, and its arguments
  /// @param log hears its standard error line by line, from another thread; may be null
  /// @param grace to end by itself once it is told to [s]
  /// @throws std::runtime_error with the reason if it cannot be started
  DriverProcess(const std::vector<std::string>& words, std::function<void(const std::string&)> log, double grace);
  ~DriverProcess();
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  /// Sends a line. What the pipe does not take at once goes out while receive() waits.
  void send(std::string_view line);

  enum class Received {
    line,
    timed_out,
    stopped,   ///< within 50 ms
    closed,    ///< it has ended, or closed one of its streams
    too_long,  ///< a line of more than `longest_line`
  };
  static constexpr std::size_t longest_line = std::size_t{16} << 20;  ///< [bytes]
  /// Waits for a line. Without a deadline it waits for ever.
  Received receive(std::string& line, const std::optional<Clock::time_point>& deadline, const std::stop_token& stop);

  /// Why nothing comes any more, for people: how it ended, and the last that it said.
  std::string end_reason();
  /// Sends the line, closes the streams, and ends what then still runs: grace, SIGTERM, grace, SIGKILL.
  void end(std::string_view farewell = {});
  bool has_ended() const { return process_ < 0; }

 private:
  bool take_line(std::string& line);
  void wait(const std::optional<Clock::time_point>& deadline);
  void write_some();
  void read_some();
  bool ends_within(double seconds) const;

  pid_t process_ = -1;
  Descriptor to_, from_;  ///< ends of pipes that never block
  std::string sending_, received_;
  std::size_t searched_ = 0;  ///< of `received_`, for the end of a line
  bool deaf_ = false, closed_ = false;
  double grace_;  ///< [s]
  std::unique_ptr<ErrorStream> errors_;
};

}  // namespace nextview
