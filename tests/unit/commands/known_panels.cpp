// Commands draw no panels: these tests announce the ones that they name.
#include <gtest/gtest.h>

#include "ui/commands/panel_list.hpp"

namespace nextview {
namespace {

struct KnownPanels : testing::Environment {
  void SetUp() override {
    std::vector<PanelInfo> panels = {{"session", "Session", Side::left, "Every setting."},
                                     {"layers", "Layers", Side::left, "What is shown."},
                                     {"log", "Log", Side::bottom, "What happened."},
                                     {panel_name::curves, "Curves", Side::bottom, "How it went."}};
    for (const std::string& name : {panel_name::view, panel_name::inspector, panel_name::gibbs, panel_name::comparison})
      panels.push_back({name, name, Side::right, "What it is."});
    announce_panels(std::move(panels));
  }
};

[[maybe_unused]] const testing::Environment* const known = testing::AddGlobalTestEnvironment(new KnownPanels);

}  // namespace
}  // namespace nextview
