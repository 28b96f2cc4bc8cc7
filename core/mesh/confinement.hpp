#pragma once
#include <chrono>
#include <cstdint>
#include <string_view>

namespace nextview {

/// Sanitizers map terabytes for their own use, and look at memory through pipes that they open: what is built with them
/// bounds no memory and filters no calls.
#if defined(__has_feature)  // Clang's way of saying it
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define NEXTVIEW_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(NEXTVIEW_SANITIZED)
inline constexpr bool can_confine = false;
#else
inline constexpr bool can_confine = true;
#endif

/// What reading one mesh file may take. A small file can ask for any amount (a count in it, nodes that share their
/// children, an archive of zeros), so what it gets follows from its size.
struct ReadingLimits {
  std::uint64_t memory = 0;          ///< beyond what the process has at its start [bytes]
  std::uint64_t companions = 0;      ///< size of the other files that the mesh lies in, together [bytes]
  std::chrono::milliseconds time{};  ///< on the wall
};
/// @param largest_file size of all files of a mesh together [bytes]
ReadingLimits reading_limits(std::string_view extension, std::uint64_t size, std::uint64_t largest_file);

/// What this process has now [bytes]; zeros where there is no /proc to tell.
struct HeldMemory {
  std::uint64_t address_space = 0, resident = 0, data = 0;
};
HeldMemory held_memory();

/// Bounds the memory of this process to what it has now and `limits.memory` more. Where there is no /proc to tell what
/// it has, nothing is bounded.
void limit_memory(const ReadingLimits& limits);
/// So many bytes of companions are read as well, and make the bound wider.
void allow_memory_for(std::uint64_t bytes);

/// Leaves this process, a child that reads a file that nobody vouches for, what reading takes and no more. By seccomp,
/// a list of what is allowed, for good: memory (none of it executable), reading what is open, opening files for reading
/// below folders that are open (never by a path from the working folder, as fopen does), writing into `pipe`, and its
/// own end. All else fails with EPERM: writing, making, renaming and removing files, sockets, other processes,
/// programs, signals to others. In addition no file takes a byte from it (RLIMIT_FSIZE), which holds without seccomp.
///
/// A kernel without seccomp filters, or an emulator, leaves it at the limits: a crafted file that takes over Assimp
/// could then do what the user can, as in any program that uses it.
/// @return whether the filter is there
bool confine(int pipe);

}  // namespace nextview
