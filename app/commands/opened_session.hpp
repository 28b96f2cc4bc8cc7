#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/commands/progress.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// A saved session, brought to where it stands, or to where it stood after so many views; nothing is written to its
/// folder. Notices go to standard error.
/// @throws std::runtime_error, std::invalid_argument in one line; Stopped
std::unique_ptr<Session> opened_session(const std::filesystem::path& folder, const std::optional<int>& views,
                                        const ProgressLine& progress, const std::stop_token& stop);

}  // namespace nextview
