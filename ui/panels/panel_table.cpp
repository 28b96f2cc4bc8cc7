#include "ui/panels/panel_table.hpp"

#include "ui/panels/candidates_panel.hpp"
#include "ui/panels/comparison_panel.hpp"
#include "ui/panels/curves_panel.hpp"
#include "ui/panels/gibbs_panel.hpp"
#include "ui/panels/inspector_panel.hpp"
#include "ui/panels/layers_panel.hpp"
#include "ui/panels/log_panel.hpp"
#include "ui/panels/session_panel.hpp"
#include "ui/panels/timeline_panel.hpp"
#include "ui/panels/view_panel.hpp"

namespace nextview {
namespace {

template <class Content>
std::unique_ptr<PanelContent> make() {
  return std::make_unique<Content>();
}

/// Of a panel that keeps nothing between frames.
template <void (*draw_panel)(const PanelContext&, const Rectangle&)>
struct Drawn : PanelContent {
  void draw(const PanelContext& context, const Rectangle& rectangle) override { draw_panel(context, rectangle); }
};

}  // namespace

std::vector<PanelEntry> standard_panels() {
  using enum Side;
  return {
      {{"session", "Session", left,
        "Every setting. Those of planner, gibbs, views and end keep the scan, the others start it over."},
       make<SessionPanel>},
      {{"layers", "Layers", left, "What the scene shows, and how."}, make<Drawn<draw_layers_panel>>},
      {{"candidates", "Candidates", right, "What each candidate view is worth."}, make<Drawn<draw_candidates_panel>>},
      {{panel_name::view, "View", right, "What a view sees, and what it is worth."}, make<Drawn<draw_view_panel>>},
      {{panel_name::inspector, "Inspector", right, "Why a voxel or a ray is as it is."},
       make<Drawn<draw_inspector_panel>>},
      {{panel_name::gibbs, "Gibbs", right, "The Gibbs map: how its chains run, and what they change."},
       make<GibbsPanel>},
      {{panel_name::curves, "Curves", bottom, "How the scan went, view by view."}, make<Drawn<draw_curves_panel>>},
      {{"timeline", "Timeline", bottom, "Every view that was taken, on each branch: go back to any of them."},
       make<TimelinePanel>},
      {{panel_name::comparison, "Compare", bottom, "What differs between this branch and another one."},
       make<Drawn<draw_comparison_panel>>},
      {{"log", "Log", bottom, "Everything that happened."}, make<LogPanel>},
  };
}

void announce_panels(const std::vector<PanelEntry>& panels) {
  std::vector<PanelInfo> infos;
  for (const PanelEntry& panel : panels) infos.push_back(panel.info);
  announce_panels(std::move(infos));
}

}  // namespace nextview
