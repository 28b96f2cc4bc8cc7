#include "core/mesh/scene_import.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <utility>

#include "core/mesh/scene_transfer.hpp"

namespace nextview {
namespace {

// Of the child.

constexpr int result_pipe = 3, folder_below = 4;

/// Whoever asks for memory that is not there ends here, wherever in Assimp that is.
[[noreturn]] void end_out_of_memory() {
  send_out_of_memory(result_pipe);
  ::_exit(0);
}

/// No file of the process that started it stays open but the pipe, and the folder if it is needed.
bool keep_open(int pipe, const std::filesystem::path* folder) {
  const int nothing = ::open("/dev/null", O_RDWR);
  const int below = folder ? ::open(folder->c_str(), O_PATH | O_DIRECTORY) : -1;
  pipe = ::fcntl(pipe, F_DUPFD, folder_below + 1);  // out of the way of what comes now
  const int kept = below < 0 ? -1 : ::fcntl(below, F_DUPFD, folder_below + 1);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, standard);
  ::dup2(pipe, result_pipe);
  if (kept >= 0) ::dup2(kept, folder_below);
  ::close_range(kept >= 0 ? folder_below + 1 : folder_below, ~0u, 0);
  return kept >= 0;
}

/// It leaves no core file, ends at the latest with the process that started it, and leaves it to that one what an
/// interrupt from the terminal means.
void settle(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_IGN);
}

[[noreturn]] void read_and_send(const MeshBytes& file, const ReadingLimits& limits, pid_t parent, int pipe) {
  settle(parent);
  const std::filesystem::path folder = file.folder.empty() ? "." : file.folder;
  const bool has_folder = keep_open(pipe, limits.companions > 0 ? &folder : nullptr);
  std::set_new_handler(end_out_of_memory);
  limit_memory(limits);
  confine(result_pipe);
  try {
    ServedFiles files{"mesh" + file.extension, file.bytes, has_folder ? folder_below : -1, limits.companions, ""};
    send_scene(result_pipe, read_scene(files));
  } catch (const std::exception& error) {
    send_message(result_pipe, error.what());
  }
  ::_exit(0);  // Not exit: what is registered to run at the end belongs to the process that started this one.
}

// Of the parent.

constexpr const char* to_do = "it is damaged or made to do harm; if it opens elsewhere, export it as binary STL or PLY";

std::runtime_error too_much_memory(const ReadingLimits& limits) {
  return std::runtime_error(fmt::format("reading it takes more memory than a file of its size needs ({} MB): {}",
                                        limits.memory >> 20, to_do));
}

}  // namespace

ImportedTriangles import_scene(MeshBytes file, const ReadingLimits& limits, std::stop_token stop) {
  const pid_t self = ::getpid();
  ReadingProcess process([&](int pipe) { read_and_send(file, limits, self, pipe); }, limits.time, std::move(stop));
  file.bytes = std::string();  // The child has them.
  ReceivedScene received;
  try {
    received = receive_scene(process);
  } catch (const ReadingProcess::TooSlow&) {
    throw std::runtime_error(fmt::format("reading it takes longer than {} s: {}", limits.time.count() / 1000, to_do));
  }
  using Kind = ReceivedScene::Kind;
  if (received.kind == Kind::scene) return std::move(received.scene);
  const ReadingProcess::Death death = process.end();
  // Not every library says so when there is no memory: some give up without a reason, some crash.
  const bool used_up = limits.companions == 0 && death.peak_memory > limits.memory / 2;
  if (received.kind == Kind::out_of_memory || used_up) throw too_much_memory(limits);
  if (received.kind == Kind::message) throw std::runtime_error(received.message);
  throw std::runtime_error(
      fmt::format("its reader, Assimp, failed ({}); the file is probably damaged: export it again", death.reason));
}

}  // namespace nextview
