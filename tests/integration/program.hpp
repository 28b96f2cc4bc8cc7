#pragma once
#include <string>

#include "core/file/own_folder.hpp"

namespace nextview {

/// What a run of the program gave.
struct Result {
  int exit_code = -1;  ///< 128 + signal if it was killed
  std::string out, err;
};

/// Runs `nextview` with these arguments (as a shell has them), without a display.
Result nextview(const std::string& arguments);
/// The same, with Ctrl+C pressed after so many seconds. Without pictures only.
Result nextview_interrupted(double seconds, const std::string& arguments);

/// The same behind commands that run others, as `timeout 5` and `sh -c '…; exec "$0" "$@"'` do.
Result nextview_behind(const std::string& commands, const std::string& arguments);

/// A folder of this test's own, empty, removed at the end.
using TemporaryFolder = OwnFolder;

}  // namespace nextview
