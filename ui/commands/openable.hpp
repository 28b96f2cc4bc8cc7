#pragma once
#include <filesystem>

#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// Refuses what cannot be opened, as far as that is told in a moment: by its name, by the settings that it carries, and
/// by what an object's file says of itself. Who reads it may still refuse it.
/// @throws std::exception that says why in one line
void require_openable(const SessionSnapshot& session, const std::filesystem::path& file);

}  // namespace nextview
