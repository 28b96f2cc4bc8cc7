// Every panel in every state of a scan, at several sizes: it is drawn in its place and nothing of it is cut off.
#include <gmock/gmock.h>

#include "tests/unit/panels/scan_states.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/workbench/inspector.hpp"

namespace nextview {
namespace {

bool is_within(const ImRect& r, const Rectangle& place) {
  return r.Min.x >= place.x - 1 && r.Min.y >= place.y - 1 && r.Max.x <= place.x + place.width + 1 &&
         r.Max.y <= place.y + place.height + 1;
}

bool overlap(const ImRect& a, const ImRect& b) {
  return a.Min.x < b.Max.x && b.Min.x < a.Max.x && a.Min.y < b.Max.y && b.Min.y < a.Max.y;
}

/// Windows with a place of their own, as opposed to what opens above them.
std::vector<const ImGuiWindow*> placed_windows() {
  std::vector<const ImGuiWindow*> result;
  for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
    const int above = ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip;
    const std::string name = w->Name;
    const bool over_scene = name.find("otif") != name.npos || name == "Question" || name == "First steps";
    if (w->WasActive && !w->Hidden && !(w->Flags & above) && !over_scene && !w->IsFallbackWindow) result.push_back(w);
  }
  return result;
}

void expect_in_place(const Layout& layout) {
  const auto windows = placed_windows();
  EXPECT_GE(windows.size(), 9u);
  for (const ImGuiWindow* w : windows) {
    int places = 0;
    for (const Rectangle& place :
         {layout.menu, layout.control_bar, layout.left, layout.right, layout.bottom, layout.status})
      places += is_within(w->Rect(), place);
    EXPECT_EQ(places, 1) << w->Name << " is in no place of the layout";
    for (const ImGuiWindow* other : windows)
      if (other != w) {
        EXPECT_FALSE(overlap(w->Rect(), other->Rect())) << w->Name << " over " << other->Name;
      }
  }
}

/// Of what cannot be scrolled nothing may lie outside.
void expect_nothing_cut_off() {
  for (const ImGuiWindow* w : placed_windows()) {
    const float right = w->DC.CursorMaxPos.x - w->InnerRect.Max.x, below = w->DC.CursorMaxPos.y - w->InnerRect.Max.y;
    EXPECT_LE(right, 1) << w->Name << " is too narrow for what it shows";
    if (w->Flags & ImGuiWindowFlags_NoScrollbar) {
      EXPECT_LE(below, 1) << w->Name << " is too low for what it shows";
    }
  }
}

void expect_triangles_clipped(const Layout& layout) {
  const ImDrawData* data = ImGui::GetDrawData();
  EXPECT_GT(data->TotalVtxCount, 500);
  for (int i = 0; i < data->CmdListsCount; ++i)
    for (const ImDrawCmd& command : data->CmdLists[i]->CmdBuffer) {
      EXPECT_GE(command.ClipRect.z, command.ClipRect.x);
      EXPECT_LE(command.ClipRect.z, layout.menu.width + 1);
    }
}

class Panels : public testing::TestWithParam<std::tuple<int, int, double>> {};

TEST_P(Panels, AreDrawnInTheirPlacesInEveryState) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  Inspector inspector;
  for (const State& state : states()) {
    desk.snapshot = state.snapshot();
    std::vector<Inspection> inspections;  // the same, whichever panel is in front
    for (const ViewSelection view :
         {ViewSelection{}, ViewSelection{ViewSelection::Kind::candidate, 0}, {ViewSelection::Kind::taken, 0}}) {
      const bool taken = view.kind == ViewSelection::Kind::taken;
      if (taken && desk.snapshot->records.empty()) continue;
      Selection selection;
      selection.view = view;
      if (taken) selection.voxel = 500;
      if (view.kind == ViewSelection::Kind::candidate) selection.ray = 3;
      inspections.push_back(inspector.inspect(desk.snapshot, selection));
    }
    for (const std::string& panel : panel_names()) {
      SCOPED_TRACE(std::string(state.name) + ", panel " + panel);
      desk.window = {};
      desk.window.bring_to_front(panel);
      desk.log.assign(3,
                      {LogEntry::Level::warning, "something that went wrong in a way that takes a line or two to say"});
      for (const Inspection& inspection : inspections) {
        desk.window.selection = inspection.selection;
        desk.inspection = inspection;
        EXPECT_TRUE(desk.frames().empty()) << "a panel did something by itself";
        expect_in_place(desk.layout());
        expect_nothing_cut_off();
        expect_triangles_clipped(desk.layout());
      }
    }
  }
}

TEST_P(Panels, AreDrawnWhileSomethingRuns) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  desk.snapshot = states()[3].snapshot();
  for (WorkerProgress progress : all_progress()) {
    if (progress.refining)
      progress.sampler = std::make_shared<const SamplerDiagnostics>(desk.snapshot->gibbs->posterior->diagnostics);
    desk.progress = progress;
    desk.window.bring_to_front(panel_name::gibbs);
    EXPECT_TRUE(desk.frames().empty());
    expect_in_place(desk.layout());
    expect_nothing_cut_off();
  }
}

TEST_P(Panels, SheetAndPaletteStayInTheWindow) {
  const auto [width, height, scale] = GetParam();
  Desk desk(width, height, scale);
  desk.snapshot = states()[2].snapshot();
  desk.window.shortcuts_open = true;
  desk.frames();
  for (const std::string name : {"Keys and mouse", "Commands", "File"}) {
    desk.window.shortcuts_open = name == "Keys and mouse";
    desk.window.palette_open = name == "Commands";
    desk.window.file_for = name == "File" ? "open" : "";
    desk.frames();
    const ImGuiWindow* w = ImGui::FindWindowByName(name.c_str());
    ASSERT_NE(w, nullptr) << name;
    EXPECT_TRUE(is_within(w->Rect(), {0, 0, double(width), double(height)}))
        << name << ": " << w->Pos.x << ", " << w->Pos.y << ", " << w->Size.x << " x " << w->Size.y;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Panels,
                         testing::Values(std::tuple(1280, 800, 1.0), std::tuple(2560, 1600, 2.0),
                                         std::tuple(1200, 720, 1.0)));

TEST(FirstSteps, AreInTheSceneUntilAViewIsTaken) {
  for (const auto& [width, height, scale] : {std::tuple(1280, 800, 1.0), {640, 480, 1.0}, {3840, 2160, 2.0}}) {
    Desk desk(width, height, scale);
    for (const std::size_t state : {0u, 1u, 2u}) {  // nothing is open, nothing is measured, some views
      desk.snapshot = states()[state].snapshot();
      desk.frames();
      const ImGuiWindow* w = ImGui::FindWindowByName("First steps");
      const bool shown = w && w->WasActive && !w->Hidden;
      const bool is_wanted = desk.snapshot->records.empty() && width > 640;
      EXPECT_EQ(shown, is_wanted) << width << ", state " << state;
      EXPECT_TRUE(!shown || is_within(w->Rect(), desk.layout().scene));
    }
    desk.snapshot = states()[1].snapshot();
    desk.window.guide_open = false;
    desk.frames();
    const ImGuiWindow* w = ImGui::FindWindowByName("First steps");
    EXPECT_TRUE(!w || !w->WasActive);
  }
}

/// However many views there are, and however small the window is.
TEST(FirstSteps, AreShownWhenTheyAreAskedForAndFitWhatIsOpen) {
  auto recording = std::make_shared<SessionSnapshot>(*states()[2].snapshot());
  auto setup = std::make_shared<ScanSetup>(*recording->setup);
  const PointCloud point(1);
  setup->recorded = std::make_shared<RecordedSurface>(
      1, [&](std::size_t) { return point; }, 0.01);
  recording->setup = setup;
  const std::vector<std::pair<std::shared_ptr<const SessionSnapshot>, const char*>> all = {
      {states()[2].snapshot(), "Take the next view"}, {recording, "nothing is captured anew"}};
  for (const auto& [width, height] : {std::pair(1280, 800), {640, 480}})
    for (const auto& [snapshot, says] : all) {
      Desk desk(width, height, 1.0);
      desk.snapshot = snapshot;
      desk.frames();
      EXPECT_EQ(read("First steps"), "");
      const auto ask = [&] {
        CommandTarget target{desk.worker(), desk.window, *desk.snapshot, desk.progress};
        execute(command::guide(), target);
        desk.frames();
      };
      ask();
      EXPECT_THAT(read("First steps"), testing::HasSubstr(says));
      EXPECT_TRUE(is_within(ImGui::FindWindowByName("First steps")->Rect(), {0, 0, double(width), double(height)}));
      ask();
      EXPECT_EQ(read("First steps"), "");
    }
}

}  // namespace
}  // namespace nextview
