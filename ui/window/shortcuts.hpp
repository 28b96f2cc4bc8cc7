#pragma once
#include <span>
#include <string_view>

#include "ui/window/input.hpp"

namespace nextview {

enum class Action {
  step,
  play,
  reset,
  frame,
  toggle_object,
  toggle_cloud,
  toggle_octree,
  toggle_views,
  toggle_rays,
  toggle_region,
  show_shortcuts,
  quit
};

/// Keys and what they do: the one list that the window obeys and the shortcut sheet shows.
struct Shortcut {
  Action action;
  Key key;
  bool control;           ///< together with the control key
  std::string_view keys;  ///< for people
  std::string_view help;
};

std::span<const Shortcut> shortcuts();

/// "S" for Action::step: the first of an action's keys.
std::string_view keys_of(Action action);

}  // namespace nextview
