#pragma once
#include <cstddef>
#include <filesystem>
#include <variant>

#include "core/session/configuration.hpp"

namespace nextview {

/// What changes a session: buttons, keys and dropped files all become one of these.
namespace command {

/// Starts over with another configuration.
struct Load {
  Configuration configuration;
};
/// Starts over with another object, or, if the file is TOML, with its settings.
struct OpenFile {
  std::filesystem::path file;
};
/// Starts over with the same configuration.
struct Reset {};
struct Step {};
/// Steps until the scan is finished or paused.
struct Play {};
/// The step that runs is still finished.
struct Pause {};
/// Makes a candidate the next view instead of the proposal.
struct TakeView {
  std::size_t candidate;
};

}  // namespace command

using SessionCommand = std::variant<command::Load, command::OpenFile, command::Reset, command::Step, command::Play,
                                    command::Pause, command::TakeView>;

}  // namespace nextview
