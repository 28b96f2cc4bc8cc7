#include "core/driver/started_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

struct Pipe {
  Descriptor reading, writing;

  Pipe() {
    std::array<int, 2> ends;
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "the driver cannot be started");
    reading = Descriptor(ends[0]);
    writing = Descriptor(ends[1]);
  }
};

/// What posix_spawn is told, freed at the end.
struct SpawnOrders {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  SpawnOrders() {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
  }
  ~SpawnOrders() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnOrders(const SpawnOrders&) = delete;
  SpawnOrders& operator=(const SpawnOrders&) = delete;
};

void give_streams(SpawnOrders& orders, const Pipe& input, const Pipe& output, const Pipe& errors) {
  ::posix_spawn_file_actions_adddup2(&orders.files, input.reading.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&orders.files, output.writing.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&orders.files, errors.writing.get(), STDERR_FILENO);
  ::posix_spawn_file_actions_addclosefrom_np(&orders.files, STDERR_FILENO + 1);
}

/// Signals that this program ignores or holds back are its own affair.
void give_usual_signals(SpawnOrders& orders) {
  sigset_t all, none;
  ::sigfillset(&all);
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigdefault(&orders.attributes, &all);
  ::posix_spawnattr_setsigmask(&orders.attributes, &none);
  ::posix_spawnattr_setpgroup(&orders.attributes, 0);
  ::posix_spawnattr_setflags(&orders.attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
}

std::string reason_of(const std::string& program, int error) {
  const bool has_folder = program.find('/') != program.npos;
  if (error == ENOENT && (has_folder ? is_there(program) : is_on_path(program)))
    return "what its first line (#!) names is not there";
  if (error == ENOENT) return has_folder ? "there is no such file" : "there is no such program on the PATH";
  if (error == EACCES) return "it may not be run; is it executable (chmod +x)?";
  if (error == ENOEXEC) return "it is no program; a script begins with a line as #!/usr/bin/env python3";
  return std::strerror(error);
}

}  // namespace

bool is_on_path(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && ::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

StartedProcess start_process(const std::vector<std::string>& words) {
  Pipe input, output, errors;
  SpawnOrders orders;
  give_streams(orders, input, output, errors);
  give_usual_signals(orders);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  StartedProcess started;
  const int error =
      ::posix_spawnp(&started.process, arguments[0], &orders.files, &orders.attributes, arguments.data(), environ);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("the driver {} cannot be started: {}", printable(words.front()), reason_of(words.front(), error)));
  started.input = std::move(input.writing);
  started.output = std::move(output.reading);
  started.errors = std::move(errors.reading);
  return started;
}

}  // namespace nextview
