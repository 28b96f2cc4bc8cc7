#include "app/commands/scarcity.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "app/commands/commands.hpp"
#include "core/memory/available_memory.hpp"
#include "core/memory/startable_threads.hpp"

namespace nextview {
namespace {

constexpr const char* advice =
    "use coarser voxels (--map.resolution), a smaller region (--map.region_edge) or fewer pixels (--sensor.width, "
    "--sensor.height); scan, refine and calibrate need less with --no-pictures";
constexpr const char* last_words =
    "nextview: out of memory while drawing or computing: raise the limit (ulimit -v), use coarser voxels "
    "(--map.resolution) or fewer pixels (--sensor.width), or --no-pictures\n";
constexpr const char* ended_by_library = "nextview: a library has ended the program, and says why above\n";
constexpr const char* display_lost =
    "nextview: the display has gone away; views that were taken are kept, and the next start offers to go on\n";
constexpr const char* no_threads =
    "nextview: no thread can be started: raise the limits (ulimit -u, ulimit -v), or use --threads 1\n";

/// What a thread takes of the address space, and a library that draws at once [bytes].
constexpr std::size_t short_below = std::size_t{256} << 20;

/// Processes that this one makes end by rules of their own.
pid_t own_process = 0;

/// Asks the kernel, as signal handlers may.
bool memory_is_short() {
  if (::getpid() != own_process) return false;
  void* probe =
      ::mmap(nullptr, short_below, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (probe == MAP_FAILED) return true;
  ::munmap(probe, short_below);
  return false;
}

[[noreturn]] void end_with(const char* line) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line, std::strlen(line));
  ::_exit(exit_bad_input);
}

/// Whether `new` has ever been refused: where an exception leaves a parallel region of OpenMP, there is nothing else
/// left of it than that the program is to end.
std::atomic<bool> was_refused = false;

void on_refusal() {
  was_refused = true;
  throw std::bad_alloc();
}

/// OpenMP's runtime ends the program with 1, which is no end of ours.
void on_end(int exit_code, void*) {
  if (exit_code == EXIT_FAILURE && ::getpid() == own_process) end_with(ended_by_library);
}

/// A library used what it had not been given. Any other fault stays what it is.
void on_fault(int signal) {
  if (memory_is_short()) end_with(last_words);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// An exception that nobody catches: in a thread of a library, or on the way out of a destructor.
void on_terminate() {
  if (::getpid() != own_process) std::abort();
  try {
    if (const auto error = std::current_exception())
      std::rethrow_exception(error);
    else if (was_refused)
      end_with(last_words);
  } catch (const std::bad_alloc&) {
    end_with(last_words);
  } catch (const OutOfMemory&) {
    end_with(last_words);
  } catch (const std::system_error&) {
    end_with(no_threads);
  } catch (...) {
  }
  std::abort();
}

void watch_for_faults() {
  own_process = ::getpid();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they have handlers of their own
  static std::array<char, 64 << 10> stack;
  const stack_t alternative{stack.data(), 0, stack.size()};
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = on_fault;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGILL}) ::sigaction(signal, &action, nullptr);
#endif
  std::set_new_handler(on_refusal);
  std::set_terminate(on_terminate);
  ::on_exit(on_end, nullptr);
}

/// Xlib, which is there with GLFW, would end the program by exit(), which takes away what other threads still use.
void watch_for_lost_display() {
  using Handler = int (*)(void* display);
  using SetHandler = Handler (*)(Handler);
  if (const auto set_handler = reinterpret_cast<SetHandler>(::dlsym(RTLD_DEFAULT, "XSetIOErrorHandler")))
    set_handler([](void*) -> int { end_with(display_lost); });
}

bool address_space_is_limited() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

void prepare_for_scarcity() {
  watch_for_faults();
  watch_for_lost_display();
  // Each thread's heap reserves 64 MB of addresses.
  if (address_space_is_limited()) ::mallopt(M_ARENA_MAX, 1);
  const int workers = static_cast<int>(std::thread::hardware_concurrency()) - 1, watchers = 1;
  const int startable = startable_threads(workers + watchers);
  if (startable == 0) throw std::runtime_error("no thread can be started: raise the limits (ulimit -u, ulimit -v)");
  if (startable >= workers + watchers) return;
  static const tbb::global_control fewer(tbb::global_control::max_allowed_parallelism,
                                         static_cast<std::size_t>(startable - watchers + 1));
  ::setenv("LP_NUM_THREADS", "0", 1);  // the threads that llvmpipe draws with
}

std::string out_of_memory_line() {
  return fmt::format("out of memory: what was to be done needs more than the {:.2f} GB that are left: {}",
                     double(available_memory()) / 1e9, advice);
}

}  // namespace nextview
