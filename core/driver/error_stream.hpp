#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "core/file/descriptor.hpp"

namespace nextview {

/// Reads what a program writes on its standard error, line by line, so that it never waits for a reader.
class ErrorStream {
 public:
  /// @param log hears each line, from a thread of its own; may be null
  ErrorStream(Descriptor pipe, std::function<void(const std::string&)> log);
  ~ErrorStream();  ///< hands on what has come so far
  ErrorStream(const ErrorStream&) = delete;
  ErrorStream& operator=(const ErrorStream&) = delete;

  /// The last line that is not empty; of a program that has ended, its very last one.
  std::string last_line();

 private:
  void run(const std::stop_token& stop);
  bool read_some();
  void take(std::string_view bytes);
  void say();

  Descriptor pipe_;
  std::function<void(const std::string&)> log_;
  std::string line_;  ///< begun
  std::mutex mutex_;
  std::condition_variable ended_;
  bool at_end_ = false;
  std::string last_;
  std::jthread thread_;
};

}  // namespace nextview
