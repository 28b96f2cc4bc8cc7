#pragma once
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace nextview {

/// A session with views that no program writes.
struct EarlierSession {
  std::filesystem::path folder;
  std::string name;  ///< for people: "gearbox"
  std::size_t views = 0;
  std::optional<double> coverage = {};  ///< of the visible or the recorded surface, where known
  std::time_t time = 0;                 ///< of its last change

  /// For people, as of a moment: "17 views, 98.2 %, today 14:05".
  std::string summary(std::time_t now = std::time(nullptr)) const;
};

/// Sessions that no one gave a folder: $XDG_STATE_HOME/nextview, or ~/.local/state/nextview. Empty if there is no home.
std::filesystem::path state_folder();
/// The folder of a session there that is called by its name alone, "2026-01-31 23.59.59 gearbox", from wherever; what
/// is no such name, or is there itself, stays as it is.
std::filesystem::path folder_of_kept(const std::filesystem::path& name);
/// A folder in there for a session of this name, by the time; it is not made. What is older than the ten newest goes,
/// unless another program writes it.
std::filesystem::path untitled_folder(const std::filesystem::path& state, const std::string& name);
/// What is known of the session in a folder, also if a program writes it; none if it cannot be read. `state`:
/// state_folder().
std::optional<EarlierSession> earlier_session(const std::filesystem::path& state, const std::filesystem::path& folder);
/// The newest session there, or of those opened from elsewhere, that nobody closed: what wrote it was ended.
std::optional<EarlierSession> unfinished_session(const std::filesystem::path& state);
/// The session that was opened or left last, wherever it is.
std::optional<EarlierSession> last_session(const std::filesystem::path& state);
/// It is not offered again. Never throws.
void close_session(const std::filesystem::path& folder);

}  // namespace nextview
