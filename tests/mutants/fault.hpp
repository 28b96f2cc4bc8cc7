// Included before each file of a build with mutants (run-mutants): which of them is the one that is switched on, by
// NEXTVIEW_FAULT=NUMBER, and which were reached, a byte each in the file NEXTVIEW_FAULTS_REACHED.
#pragma once
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace nextview_fault {

inline unsigned char* open_reached() {
  const char* const path = std::getenv("NEXTVIEW_FAULTS_REACHED");
  const int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
  if (file < 0) return nullptr;
  // Shared: what a child reaches that may no longer open a file counts, too.
  void* const bytes = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return bytes == MAP_FAILED ? nullptr : static_cast<unsigned char*>(bytes);
}
inline int read_chosen() {
  const char* const number = std::getenv("NEXTVIEW_FAULT");
  return number ? std::atoi(number) : 0;
}

inline unsigned char* const reached = open_reached();
inline const int chosen = read_chosen();

/// For code that always runs.
inline bool is(int number) noexcept {
  if (reached) reached[number] = 1;
  return number == chosen;
}
/// For functions that may be evaluated while compiling, too: there no fault is on.
constexpr bool is_later(int number) noexcept { return !__builtin_is_constant_evaluated() && is(number); }

}  // namespace nextview_fault
