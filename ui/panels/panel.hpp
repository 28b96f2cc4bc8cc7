#pragma once
#include <string>
#include <vector>

#include "ui/commands/command.hpp"
#include "ui/panels/layout.hpp"
#include "ui/panels/panel_pictures.hpp"
#include "ui/panels/style.hpp"
#include "ui/workbench/inspection.hpp"

namespace nextview {

/// What every panel sees, none of which changes while it is drawn, and where it says what it wants done.
struct PanelContext {
  const SessionSnapshot& snapshot;
  const WorkerProgress& progress;
  const WindowState& window;
  const Inspection& inspection;
  const SessionLog::Entries& log;
  const Style& style;
  PanelPictures& pictures;
  std::vector<CommandCall>& calls;
  std::optional<std::size_t>& hovered;  ///< candidate that is pointed at

  CommandState state() const { return {snapshot, progress, window}; }

  /// Emits a command. @throws std::invalid_argument if there is none of this name, or its values do not fit.
  template <class... Values>
  void call(std::string_view name, const Values&... values) const {
    calls.push_back(make_call(name, {text_of(values)...}));
  }
  /// Emits a command if it can be done now; asks for the values that are missing in the palette.
  void invoke(const Command& command) const;

 private:
  static std::string text_of(const std::string& value) { return value; }
  static std::string text_of(const char* value) { return value; }
  static std::string text_of(double value);
  static std::string text_of(std::size_t value) { return std::to_string(value); }
  static std::string text_of(int value) { return std::to_string(value); }
};

/// A part of the window with a fixed place, from its construction to its end.
class Panel {
 public:
  /// What needs a larger width than the place has [px] is scrolled.
  Panel(const char* name, const Rectangle& rectangle, ImGuiWindowFlags flags = 0, float least_width = 0);
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
/// Whether one is shown, or would be if what is pointed at had one.
bool tooltip_is_due(const ImGuiContext& imgui);
/// When the next one appears if the pointer stays where it is [s]; infinity if there is none to come.
double seconds_to_tooltip(const ImGuiContext& imgui);

/// What the panels of a side are made for [px] on a display that does not scale.
constexpr float left_panel_width = 272, right_panel_width = 336;

/// As much of a text as fits into a width [px], with an ellipsis for the rest.
std::string shortened(const std::string& text, float width);

/// The panels of a side, as tabs at the top of its place, or as a list where they would not fit; returns the rectangle
/// that is left beneath them. Of a place that is not `open` they are all there is, and none is in front.
Rectangle draw_tabs(const PanelContext& context, Side side, const Rectangle& rectangle, bool open = true);
/// "Session", …
const char* title_of(PanelName panel);

enum class Icon { none, step, play, pause, reset, cancel, warning, undo, redo };

/// A button with an icon before its label. A primary button stands out: it is what a person most likely wants.
bool icon_button(const Style& style, Icon icon, const char* label, bool primary = false, float width = 0);
/// A button for a command: its icon and label, disabled while the command cannot be done, with the declaration's help,
/// keys and reason as its tooltip. `width` 0: as wide as it needs to be.
void command_button(const PanelContext& context, std::string_view name, Icon icon, const char* label,
                    bool primary = false, float width = 0);
/// What a command's tooltip says: help, keys, and why it cannot be done now.
std::string help_of(const PanelContext& context, const Command& command);
/// One of several choices, as a row of buttons that hang together; returns the one that was pressed.
std::optional<std::size_t> segmented(const PanelContext& context, const char* id, std::span<const char* const> names,
                                     std::size_t selected, std::span<const char* const> help = {});
/// "name    value" in a table of two columns, which must be open.
void table_row(const std::string& name, const std::string& value, const std::string& help = "");
/// Draws an icon into a square.
void draw_icon(Icon icon, ImVec2 centre, float size, ImU32 colour);

/// "1234567", "1234", "12.35", "0.00123": as many digits as people can use.
std::string readable(double value);

}  // namespace nextview
