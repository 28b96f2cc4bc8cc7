#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/journal/journal.hpp"
#include "core/session/session.hpp"

namespace nextview {

inline constexpr const char* state_file_name = "state";

/// Writes where a session stands, so that it is opened without working it out again. Derived from the journal and its
/// scans, like a map: it holds only for this line of captures, these settings and this version, and may be deleted.
/// False, and nothing, where it would not be whole: with a Gibbs or a reference map, or candidates that change from
/// view to view or did in number.
/// @throws std::runtime_error naming the file and the reason
bool write_state_file(const Session& session, std::span<const JournalStep> line, const std::filesystem::path& file);

/// The state that was written; none if there is no such file, or it is of anything else than this session, with this
/// configuration, after these captures. It is what taking them again would give, to the bit. Never throws but
/// OutOfMemory.
std::optional<ScanState> read_state_file(const Session& session, std::span<const JournalStep> line,
                                         const std::filesystem::path& folder);

/// Where the scan stood after some of its views, the last one reached as the robot knew it, without its maps: remake()
/// makes them.
ScanState earlier_state(const ScanSetup& setup, const ScanState& state, std::size_t views, const Pose& reached);

}  // namespace nextview
