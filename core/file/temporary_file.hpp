#pragma once
#include <sys/types.h>

#include <filesystem>

#include "core/file/descriptor.hpp"

namespace nextview {

/// A new file whose name nobody can foresee. Its writer holds a lock on it, which ends with the process.
struct TemporaryFile {
  std::filesystem::path file;
  Descriptor descriptor;
};

/// `permissions` as for open(2), less the umask. @throws std::system_error
TemporaryFile make_temporary_file(const std::filesystem::path& folder, mode_t permissions);

/// Removes the temporary files of writers that were killed. They are told from others by their names and by the lock
/// that nobody holds any more.
void remove_abandoned_temporary_files(const std::filesystem::path& folder);

}  // namespace nextview
