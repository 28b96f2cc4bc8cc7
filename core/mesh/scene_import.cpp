#include "core/mesh/scene_import.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace nextview {
namespace {

constexpr rlim_t longest_reading = 600;  // processor time [s]

/// What goes through the pipe, in this order: this header, the message or the vertices, the triangles.
struct Header {
  std::uint64_t message = 0, vertices = 0, triangles = 0;
};

bool send(int pipe, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::write(pipe, bytes, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive(int pipe, void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = ::read(pipe, bytes, size);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    bytes += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// It prints nothing, leaves no core file, and ends at the latest with the process that started it.
void restrain() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  const rlimit no_core = {0, 0}, time = {longest_reading, longest_reading};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_CPU, &time);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
}

[[noreturn]] void read_and_send(const std::filesystem::path& file, int pipe) {
  restrain();
  try {
    const ImportedTriangles read = read_scene(file);
    const Header header = {0, read.vertices.size(), read.triangles.size()};
    send(pipe, &header, sizeof(header)) && send(pipe, read.vertices.data(), bytes_of(read.vertices)) &&
        send(pipe, read.triangles.data(), bytes_of(read.triangles));
  } catch (const std::exception& error) {
    const std::string_view message = error.what();
    const Header header = {message.size() + 1, 0, 0};
    send(pipe, &header, sizeof(header)) && send(pipe, error.what(), message.size() + 1);
  }
  ::_exit(0);  // Not exit: what is registered to run at the end belongs to the process that started this one.
}

/// @return whether all of it came
bool receive_scene(int pipe, ImportedTriangles& scene, std::string& message) {
  Header header;
  if (!receive(pipe, &header, sizeof(header))) return false;
  message.resize(header.message);
  scene.vertices.resize(header.vertices);
  scene.triangles.resize(header.triangles);
  return receive(pipe, message.data(), message.size()) &&
         receive(pipe, scene.vertices.data(), bytes_of(scene.vertices)) &&
         receive(pipe, scene.triangles.data(), bytes_of(scene.triangles));
}

/// Reads one end of a pipe that another process fills, and waits for that process in the end.
class ReadingProcess {
 public:
  explicit ReadingProcess(const std::filesystem::path& file) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot start its reader");
    process_ = ::fork();
    if (process_ == 0) read_and_send(file, ends[1]);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (process_ < 0) {
      ::close(pipe_);
      throw std::system_error(errno, std::generic_category(), "cannot start its reader");
    }
  }
  ~ReadingProcess() {
    ::close(pipe_);
    if (!ended_) wait();
  }
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;

  int pipe() const { return pipe_; }
  /// @return its wait status
  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    ended_ = true;
    return status;
  }

 private:
  pid_t process_ = -1;
  int pipe_ = -1;
  bool ended_ = false;
};

}  // namespace

ImportedTriangles import_scene(const std::filesystem::path& file) {
  ReadingProcess process(file);
  ImportedTriangles scene;
  std::string message;
  const bool complete = receive_scene(process.pipe(), scene, message);
  const int status = process.wait();
  if (!complete)
    throw std::runtime_error(
        fmt::format("cannot be read: Assimp, which reads it, failed ({}); the file is probably damaged",
                    WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : "no result"));
  if (!message.empty()) throw std::runtime_error(message.c_str());
  return scene;
}

}  // namespace nextview
