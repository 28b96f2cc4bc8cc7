#pragma once
#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// The Gibbs sampler: running and holding it, whether its chains are stationary, and what it changed.
class GibbsPanel : public PanelContent {
 public:
  void draw(const PanelContext& context, const Rectangle& rectangle) override;

 private:
  void draw_controls(const PanelContext& context);

  std::string out_of_bounds_;    ///< why a number became another; empty: none did
  int chains_ = 0, sweeps_ = 0;  ///< of the next run; 0: as the settings say
};

}  // namespace nextview
