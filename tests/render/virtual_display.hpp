#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace nextview {

/// Starts a program with its arguments; -1 if it cannot be.
pid_t start(const std::vector<std::string>& command);
/// Once it has ended; -1 if it was killed.
int exit_status(pid_t process);

/// An X server without a screen, on a display that is free.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool ready() const { return server_ > 0 && !name_.empty(); }
  std::string name() const { return ":" + name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace nextview
