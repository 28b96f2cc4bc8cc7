#pragma once
#include <stop_token>
#include <string_view>
#include <thread>

namespace nextview {

/// Turns Ctrl+C into a requested stop, so that what has been done is still written. One at a time.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  std::stop_token token() const { return source_.get_token(); }

 private:
  void (*previous_)(int);
  std::stop_source source_;
  std::jthread watcher_;
};

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
