#pragma once
#include <string>
#include <vector>

#include "ui/panels/style.hpp"
#include "ui/window/layout.hpp"
#include "ui/window/session_command.hpp"
#include "ui/window/session_snapshot.hpp"

namespace nextview {

/// What every panel sees, and where it says what it wants done.
struct PanelContext {
  const SessionSnapshot& snapshot;
  const WorkerProgress& progress;
  const Style& style;
  std::vector<SessionCommand>& commands;
};

/// A part of the window with a fixed place, from its construction to its end.
class Panel {
 public:
  Panel(const char* name, const Rectangle& rectangle, ImGuiWindowFlags flags = 0);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
};

/// A panel's or a group's caption.
void heading(const Style& style, const char* text);
/// Secondary text in the smaller font.
void small_text(const Style& style, const std::string& text, const Colour& colour = theme::soft_ink);
/// Shows `text` beside the last item, even if that is disabled, once the pointer has been on it for a moment.
void tooltip(const std::string& text);
/// When the next one appears if the pointer stays where it is [s]; infinity if there is none to come.
double seconds_to_tooltip(const ImGuiContext& imgui);

enum class Icon { step, play, pause, reset, cancel, warning };

/// A button with an icon before its label. A primary button stands out: it is what a person most likely wants.
bool icon_button(const Style& style, Icon icon, const char* label, bool primary = false);
/// Draws an icon into a square.
void draw_icon(Icon icon, ImVec2 centre, float size, ImU32 colour);

/// "1234567", "1234", "12.35", "0.00123": as many digits as people can use.
std::string readable(double value);

}  // namespace nextview
