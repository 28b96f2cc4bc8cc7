#pragma once
#include "ui/panels/panel.hpp"

namespace nextview {

/// The settings that people change most. A change starts the scan over.
class SessionPanel {
 public:
  void draw(PanelContext& context, const Rectangle& rectangle);

 private:
  void draw_object(PanelContext& context, std::vector<Setting>& settings);
  void draw_sensor(PanelContext& context, std::vector<Setting>& settings);
  void load(PanelContext& context) const;

  Configuration edited_;
  std::uint64_t session_ = 0;  ///< the one that `edited_` was taken from
};

}  // namespace nextview
