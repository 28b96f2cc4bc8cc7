#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>

namespace nextview {

/// What a name means to who writes there. Symbolic links are followed, as a shell's `>` does: the link stays, and what
/// it points to is written.
struct OutputTarget {
  std::filesystem::path file;  ///< behind all links; need not exist
  /// A pipe, a terminal or another device, or an open file of this process (/dev/stdout): written to, never replaced.
  bool is_stream = false;
  struct Standing {
    mode_t permissions;
    uid_t owner;
    gid_t group;
  };
  std::optional<Standing> standing;  ///< of the regular file that is there
};

/// @throws std::runtime_error naming the file and the reason: a folder, a disk, a socket, links in a circle, a file
///         that may not be written.
OutputTarget output_target(const std::filesystem::path& file);

}  // namespace nextview
