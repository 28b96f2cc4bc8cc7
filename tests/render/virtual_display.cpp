#include "tests/render/virtual_display.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace nextview {

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (::posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return -1;
  return process;
}

int exit_status(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

VirtualDisplay::VirtualDisplay() {
  int ends[2];
  if (::pipe(ends) != 0) return;
  // A server that begins anew when its last client leaves would turn away whoever comes at that moment.
  server_ = start(
      {"Xvfb", "-displayfd", std::to_string(ends[1]), "-noreset", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"});
  ::close(ends[1]);
  char c = 0;
  while (::read(ends[0], &c, 1) == 1 && c != '\n') name_ += c;  // ends when the server is ready, or has ended
  ::close(ends[0]);
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  ::kill(server_, SIGTERM);
  exit_status(server_);
}

}  // namespace nextview
