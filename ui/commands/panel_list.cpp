#include "ui/commands/panel_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nextview {
namespace {

std::vector<PanelInfo>& announced() {
  static std::vector<PanelInfo> panels;
  return panels;
}

}  // namespace

std::span<const PanelInfo> panel_list() { return announced(); }

std::vector<std::string> panel_names() {
  std::vector<std::string> names;
  for (const PanelInfo& panel : panel_list()) names.push_back(panel.name);
  return names;
}

const PanelInfo& panel_info(std::string_view name) {
  const auto panels = panel_list();
  const auto found = std::find_if(panels.begin(), panels.end(), [&](const PanelInfo& p) { return p.name == name; });
  if (found == panels.end())
    throw std::invalid_argument(
        fmt::format("there is no panel '{}'; there are {}", name, fmt::join(panel_names(), ", ")));
  return *found;
}

void announce_panels(std::vector<PanelInfo> panels) { announced() = std::move(panels); }

}  // namespace nextview
