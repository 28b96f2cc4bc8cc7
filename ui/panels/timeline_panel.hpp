#pragma once
#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// The views of all branches, a row each, as small pictures. A click or a drag goes to where there were so many views.
class TimelinePanel : public PanelContent {
 public:
  void draw(const PanelContext& context, const Rectangle& rectangle) override;

 private:
  struct Row;
  void draw_row(const PanelContext& context, const Row& row);
  void draw_cells(const PanelContext& context, const Row& row);
  void go_to(const PanelContext& context, const Row& row, std::size_t views);

  bool dragging_ = false;                             ///< along the views
  std::pair<std::size_t, std::size_t> gone_to_{};     ///< branch and views, by the drag
  std::pair<std::size_t, std::uint32_t> followed_{};  ///< branch and step that were scrolled to last
};

}  // namespace nextview
