#pragma once
#include "core/offline/scene_scores.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// The candidate views of a session as it stands, scored as it would rank them for the next view by each of these
/// gains. Views that are taken or out of reach have none (not a number). The session's own planner stands again
/// afterwards.
/// @throws std::invalid_argument without a view, or for a gain that makes no sense; OutOfMemory; Stopped
SceneScores score_session(Session& session, std::span<const std::string> names, const Progress& progress = {},
                          const std::stop_token& stop = {});

}  // namespace nextview
