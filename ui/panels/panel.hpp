#pragma once
#include <string>
#include <vector>

#include "ui/commands/command.hpp"
#include "ui/panels/icons.hpp"
#include "ui/panels/layout.hpp"
#include "ui/panels/panel_pictures.hpp"
#include "ui/panels/style.hpp"
#include "ui/workbench/found_surface.hpp"
#include "ui/workbench/inspection.hpp"
#include "ui/workbench/session_log.hpp"

namespace nextview {

/// What every panel sees, none of which changes while it is drawn, and where it posts what it wants done. Neither the
/// session nor what runs it is within reach.
struct PanelContext {
  const SessionSnapshot& snapshot;
  const WorkerProgress& progress;
  const WindowState& window;
  const Inspection& inspection;
  const SessionLog::Entries& log;
  const Style& style;
  PanelPictures& pictures;
  std::vector<CommandCall>& calls;
  std::optional<std::size_t>& hovered;           ///< candidate that is pointed at
  const FoundSurface* surface = nullptr;         ///< the latest that was made; null: none
  std::optional<SurfaceJob> surface_progress{};  ///< of the one that is being made

  CommandState state() const { return {snapshot, progress, window}; }

  /// post(command::speed(0.5)): it is done after the frame.
  void post(CommandCall call) const { calls.push_back(std::move(call)); }
  /// Posts a command without values; asks for a file in the dialog, for other values in the palette. If it cannot be
  /// done now, the log says why.
  void invoke(const Command& command) const;
};

/// A part of the window with a fixed place, from its construction to its end.
class Panel {
 public:
  /// What needs a larger width than the place has [px] is scrolled.
  Panel(const char* name, const Rectangle& rectangle, ImGuiWindowFlags flags = 0, float min_width = 0);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;
};

/// Since the last frame, or again and again while it is held.
bool pressed(Key key, bool repeats = false);

/// A panel's or a group's caption.
void heading(const Style& style, const char* text);
/// In as many lines as it needs, none of which ends between a number and its unit.
void wrapped_text(const std::string& text);
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

/// A button with an icon before its label. A primary button stands out: it is what the user most likely wants.
bool icon_button(const Style& style, Icon icon, const char* label, bool primary = false, float width = 0);
/// A button for a command: its icon and label, disabled while the command cannot be done, with the declaration's help,
/// keys and reason as its tooltip. `width` 0: as wide as it needs to be.
void command_button(const PanelContext& context, const Command& command, Icon icon, const char* label,
                    bool primary = false, float width = 0);
/// What a command's tooltip says: help, keys, and why it cannot be done now.
std::string help_of(const PanelContext& context, const Command& command);
/// One of several choices, as a row of buttons that hang together; returns the one that was pressed.
std::optional<std::size_t> segmented(const PanelContext& context, const char* id, std::span<const char* const> names,
                                     std::size_t selected, std::span<const char* const> help = {});
/// "name    value" in a table of two columns, which must be open.
void table_row(const std::string& name, const std::string& value, const std::string& help = "");
/// "the first view", "the first 3 views".
std::string first_views(std::size_t count);
/// "1234567", "1234", "12.35", "0.00123": as many digits as people can use.
std::string readable(double value);
/// The same with its unit; areas in the unit that suits them.
std::string readable(double value, const std::string& unit);

}  // namespace nextview
