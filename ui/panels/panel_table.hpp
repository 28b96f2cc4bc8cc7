#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "ui/commands/panel_list.hpp"

namespace nextview {

struct PanelContext;
struct Rectangle;

/// What a panel shows, from frame to frame.
class PanelContent {
 public:
  virtual ~PanelContent() = default;
  virtual void draw(const PanelContext& context, const Rectangle& rectangle) = 0;
};

/// A panel as it is offered.
struct PanelEntry {
  PanelInfo info;
  std::function<std::unique_ptr<PanelContent>()> make;
};

/// The program's panels, in the order of their keys and tabs. A new one is a file and a line in panel_table.cpp.
std::vector<PanelEntry> standard_panels();
/// So that commands know their names.
void announce_panels(const std::vector<PanelEntry>& panels);

}  // namespace nextview
