#pragma once
#include <filesystem>

#include "ui/commands/window_state.hpp"

namespace nextview {

/// What of a window is kept for the next one.
struct WindowPreferences {
  double text_scale = 1.0;  ///< of text and controls, beside the display's: chosen on one, it suits another, too
  bool guide = true;        ///< what to do first is shown
  bool dark = false;
  PlaceSizes place_sizes = {};

  bool operator==(const WindowPreferences&) const = default;
};

/// How large text is at first on a display of so many pixels that does not scale; its own word on how wide it is [mm].
double usual_text_scale(int width, int height, int millimetres);
/// Those in `state` (state_folder()); the usual ones where none are, or they make no sense.
WindowPreferences read_preferences(const std::filesystem::path& state);
/// Never throws: what cannot be kept is not.
void keep_preferences(const std::filesystem::path& state, const WindowPreferences& preferences);

}  // namespace nextview
