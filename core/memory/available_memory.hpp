#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace nextview {

/// One line: what needed how much, and what to do.
struct OutOfMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What this process may still take [bytes]: the least of what its limits (`ulimit -v`, `ulimit -d`), its control
/// groups and the machine leave it, as the files below `root` have it.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// To be asked before something large is made, while everything is still whole.
/// @throws OutOfMemory "WHAT needs 2.3 GB, 0.8 GB are available: ADVICE" if `bytes` are not available.
void require_memory(std::uint64_t bytes, std::string_view what, std::string_view advice);

/// Gives the system what was freed here and there, which the allocator would keep: a window that opens session after
/// session does not grow. Takes some milliseconds.
void return_freed_memory();

}  // namespace nextview
