#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace nextview {

/// A session that nobody closed: what wrote it was ended.
struct UnfinishedSession {
  std::filesystem::path folder;
  std::string name;  ///< for people: "gearbox"
  std::size_t views = 0;
};

/// Sessions that no one gave a folder: $XDG_STATE_HOME/nextview, or ~/.local/state/nextview. Empty if there is no home.
std::filesystem::path state_folder();
/// A folder in there for a session of this name, by the time; it is not made. What is older than the ten newest goes,
/// unless another program writes it.
std::filesystem::path untitled_folder(const std::filesystem::path& state, const std::string& name);
/// The newest session there that has views, was not closed, and that no program writes.
std::optional<UnfinishedSession> unfinished_session(const std::filesystem::path& state);
/// It is not offered again. Never throws.
void close_session(const std::filesystem::path& folder);

}  // namespace nextview
