#pragma once
#include <cstddef>

#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// A line of the log, with a sign of its level.
void draw_entry(const Style& style, const LogEntry& entry);

/// Everything that happened, the latest at the bottom; warnings stand out.
class LogPanel : public PanelContent {
 public:
  void draw(const PanelContext& context, const Rectangle& rectangle) override;

 private:
  std::size_t shown_ = 0;  ///< entries, when it was last drawn
};

}  // namespace nextview
