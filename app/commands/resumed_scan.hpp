#pragma once
#include <filesystem>

#include "app/commands/options.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {

// What `scan --resume` looks at before it goes on.

/// Everything but the end of a scan, and which scans are rejected, stays as it was. Whether that has changed. @throws
/// std::invalid_argument
bool adopt_changes(const ConfigurationOptions& options, SavedSession& saved);
/// By settings that would have ended the scan earlier, config.toml would no longer repeat it.
/// @throws std::invalid_argument
void require_no_earlier_end(const Session& session, const SavedSession& saved);
/// Of a scan that had ended, other views would take the place of lost ones, and their results that of its own.
/// @throws std::runtime_error in one line that names the first that is lost
void require_captures_of_results(const SavedSession& saved);
/// Whether all files of a scan are there, with its pictures and its surfaces if they are wanted.
bool has_files(const std::filesystem::path& folder, bool pictures, bool surfaces);

}  // namespace nextview
