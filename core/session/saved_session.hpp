#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/journal/journal.hpp"
#include "core/results/input_file.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// What the folder of a session says, however old it is.
struct SavedSession {
  std::filesystem::path folder;
  Configuration configuration;
  std::optional<Journal> journal;    ///< none in those of 0.4.0 and earlier
  std::vector<std::string> notices;  ///< what is lost, or sensed again, for people
};

/// Whether a folder holds a session: one with a journal, or what `scan` of 0.4.0 left.
bool is_session(const std::filesystem::path& folder);
/// @throws std::runtime_error, std::invalid_argument naming the file and the reason: none of a session, a newer
/// version's, the object has changed
SavedSession read_session(const std::filesystem::path& folder);
/// What is in the way of a session that is yet to be written to a folder; what it reads is not, nor is a session
/// without views.
enum class InTheWay { nothing, session, others };
InTheWay in_the_way(const std::filesystem::path& folder, std::span<const InputFile> inputs);
/// For what replaces earlier results and is no session: captures cannot be made again. @throws std::invalid_argument
/// naming the folder and another one
void require_no_session(const std::filesystem::path& folder);

class SessionFolder;

/// Takes views again that were captured before, from where the session stands, each ranked by the planner of then: the
/// same bytes; the session is left with the planner with which it last stood there. Where a capture is lost the view is
/// left out, and a notice added. `each` is called after each view, with the number of its capture. False if it was
/// stopped. @pre saved.journal @throws as Session::step
bool take_again(Session& session, SavedSession& saved, std::span<const JournalStep> line,
                const std::function<void(std::uint32_t)>& each, const Progress& progress = {},
                const std::stop_token& stop = {});

/// Brings a new session to where the saved one stands, by what it kept for that (write_state_file): the same as
/// restore(), in a moment. False if it kept nothing, or that is out of date; then the session is as it was.
bool restore_kept(Session& session, const SavedSession& saved, SessionFolder* folder);
/// The settings to make the session with: those of now, but for the candidate views that it began with.
Configuration began_with(const SavedSession& saved);
/// What ranked the views when this one was chosen. @pre saved.journal
PlanningConfig chosen_by(const SavedSession& saved, const JournalStep& step);
/// The settings with which it last stood at a step. @pre saved.journal
Configuration settings_at(const SavedSession& saved, std::uint32_t number);

/// Brings a new session to where the saved one stands: its views are taken again from what was captured, the same
/// bytes; those of 0.4.0 are sensed again. Where a capture is lost the view is left out, and a notice added. `folder`,
/// if given, is that of the session. `each` is called after each view, with
/// the number of its capture. False if it was stopped.
/// @throws as Session::step
bool restore(Session& session, SavedSession& saved, SessionFolder* folder,
             const std::function<void(std::uint32_t)>& each = {}, const Progress& progress = {},
             const std::stop_token& stop = {});

}  // namespace nextview
