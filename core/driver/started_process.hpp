#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

#include "core/file/descriptor.hpp"

namespace nextview {

/// A program that runs, and this process's ends of its standard streams.
struct StartedProcess {
  pid_t process = -1;  ///< also the number of its process group
  Descriptor input, output, errors;
};

/// Whether a program of this name may be run from a folder of the PATH.
bool is_on_path(const std::string& program);

/// Starts a program, looked for on the PATH, in a process group of its own, with the usual signals and without any
/// other open file. @throws std::runtime_error with one line that says why it cannot be started
StartedProcess start_process(const std::vector<std::string>& words);

}  // namespace nextview
