#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ui/panels/file_dialog.hpp"
#include "ui/panels/manual_sheet.hpp"
#include "ui/panels/menu_bar.hpp"
#include "ui/panels/notifications.hpp"
#include "ui/panels/palette.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// Every panel in its place. Needs no pixels: tests drive it without a surface.
class AllPanels {
 public:
  /// Announces the panels to the commands.
  explicit AllPanels(const std::vector<PanelEntry>& panels = standard_panels());
  /// `log_count`: of all entries ever; `seconds`: since the last frame.
  void draw(const PanelContext& context, const Layout& layout, std::size_t log_count, double seconds);
  /// Emits the commands whose keys are pressed, before draw(). Whatever is in front has the keyboard: a menu or a list,
  /// then the file dialog, the palette, a question, the sheet of keys, the manual, a text that is written; Escape
  /// closes it, and no other key does anything else.
  void obey_keys(const PanelContext& context);
  /// How long the picture stays as it is if nothing happens [s].
  double seconds_left() const { return notifications_.seconds_left(); }

 private:
  void draw_side(const PanelContext& context, Side side, const Rectangle& rectangle, bool is_open);
  void begin_among_controls(const PanelContext& context);
  void show_no_focus_after_clicks();
  void come_back_from_front(const PanelContext& context);
  bool question_was_seen(const PanelContext& context);

  std::map<std::string, std::unique_ptr<PanelContent>> contents_;  ///< by the panel's name
  Palette palette_;
  FileDialog file_dialog_;
  ManualSheet manual_;
  RecentMenu recent_;
  Notifications notifications_;
  std::string in_front_;  ///< the title of the panel that was brought there last, in the last frame
  int popups_ = 0;        ///< menus and lists that were open in the last frame; Escape has closed one since, maybe
  bool focus_was_shown_ = false;  ///< in the frame before: by keys
  bool was_covered_ = false;      ///< likewise, by what has the keyboard in the panels' place
  ImGuiID left_at_ = 0;           ///< the window that had the keyboard before that
  bool left_with_ring_ = false;
  std::pair<std::uint64_t, std::string> asked_;  ///< the number and the text of the question of the last frame
  std::optional<double> asked_since_;            ///< when it was in sight, in ImGui's time [s]; none: it is new
};

}  // namespace nextview
