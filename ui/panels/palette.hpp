#pragma once
#include <string>

#include "ui/panels/palette_search.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// All commands in one list: a part of a name, or of what it does, finds them, and settings with them; a whole line of
/// a script with its values does it.
class Palette {
 public:
  void draw(const PanelContext& context, const Rectangle& scene);

 private:
  static bool draw_entry(const PanelContext& context, const PaletteEntry& entry, bool chosen);
  void draw_commands(const PanelContext& context);
  void draw_setting(const PanelContext& context) const;
  void draw_values(const PanelContext& context, const Command& command);
  void run(const PanelContext& context);
  void put(std::string text);
  void forget_choice();
  bool choose_by_keys(std::size_t count);
  std::string completed(const std::string& text, const PanelContext& context) const;

  bool open_ = false;
  bool put_ = false;  ///< the text was changed by us: the cursor goes to its end
  std::string text_, error_;
  std::size_t chosen_ = 0;  ///< in the list
  bool is_chosen_ = false;  ///< by the arrow keys: Enter takes it
  float room_ = 0;          ///< for the list [px of height]
};

}  // namespace nextview
