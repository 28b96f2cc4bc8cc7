#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui/panels/panel.hpp"

namespace nextview {

/// What was opened last: read once each time that its menu opens, as the sessions among it are looked into.
struct RecentMenu {
  struct Entry {
    std::filesystem::path file;
    std::string name, summary;  ///< EarlierSession's; of other files the latter is empty
  };
  std::vector<Entry> entries;

  void read();
};

/// All commands, menu by menu.
void draw_menu_bar(const PanelContext& context, const Rectangle& rectangle, RecentMenu& recent);

}  // namespace nextview
