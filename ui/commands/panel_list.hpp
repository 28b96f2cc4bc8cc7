#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

enum class Side { left, right, bottom };

/// A panel as commands and tabs know it.
struct PanelInfo {
  std::string name;   ///< in scripts: "view"
  std::string title;  ///< of its tab: "View"
  Side side;          ///< panels of a side share its place, one in front
  std::string help;   ///< one sentence: the tab's tooltip
};

/// Those that commands bring to the front themselves.
namespace panel_name {
inline const std::string view = "view", inspector = "inspector", gibbs = "gibbs", curves = "curves",
                         comparison = "comparison";
}

/// The panels there are, in the order of their keys. Commands draw none and so know none by themselves: who draws them
/// announces them before a script is read or a window made (ui/panels/panel_table.hpp).
std::span<const PanelInfo> panel_list();
std::vector<std::string> panel_names();
/// @throws std::invalid_argument naming the known ones.
const PanelInfo& panel_info(std::string_view name);
/// In place of those that were announced before. Not while another thread reads the list.
void announce_panels(std::vector<PanelInfo> panels);

}  // namespace nextview
