#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <functional>

namespace nextview {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool memory_can_be_limited = false;  // they reserve terabytes of addresses
#else
inline constexpr bool memory_can_be_limited = true;
#endif

/// Whether `check` holds in a process of its own.
inline bool holds_in_child(const std::function<bool()>& check) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(check() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// What this process has of a field of /proc/self/statm: 0 its addresses, 5 its data [bytes].
inline std::uint64_t pages_taken(int field) {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  for (int i = 0; i <= field; ++i) statm >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Leaves this process so many bytes of RLIMIT_AS or RLIMIT_DATA beyond those that it has. What is the most that it may
/// have stays as it was: only root may raise that.
template <class Resource>
bool leave(Resource resource, std::uint64_t bytes) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = pages_taken(resource == RLIMIT_AS ? 0 : 5) + bytes;
  return ::setrlimit(resource, &limit) == 0;
}

}  // namespace nextview
