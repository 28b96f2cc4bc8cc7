#pragma once
#include <array>
#include <csignal>
#include <stop_token>
#include <string_view>
#include <thread>

namespace nextview {

/// What asks a program to end: Ctrl+C, `kill`, a terminal that closes.
inline constexpr std::array stop_signals = {SIGINT, SIGTERM, SIGHUP};

/// From here on a stop signal ends the process at once, with one line and exit_stopped: there is nothing to keep. One
/// that is ignored (nohup) stays ignored.
void end_on_interrupt();

/// While it lives, the first stop signal becomes a requested stop, so that what has been done is still written; a
/// second one ends the process at once. One at a time.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  std::stop_token token() const { return source_.get_token(); }
  /// Whether a signal came: the token knows of it up to a twentieth of a second later.
  bool asked() const;

 private:
  std::array<struct sigaction, stop_signals.size()> previous_;
  std::stop_source source_;
  std::jthread watcher_;
};

/// Shows at once what has been printed to standard output. Where nobody reads it any more (`| head -3`), what follows
/// goes nowhere, and the run goes on to its end.
void flush_output();

/// A line on a terminal that tells what is going on; nothing where errors go to a file.
class ProgressLine {
 public:
  ProgressLine();
  void operator()(double fraction, std::string_view what) const;
  void clear() const;

 private:
  bool visible_;
};

}  // namespace nextview
