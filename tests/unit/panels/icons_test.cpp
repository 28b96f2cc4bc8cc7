// Icons by their shapes: each is another one, in its square, and none is nothing.
#include "ui/panels/icons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/panels/desk.hpp"
#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {
namespace {

constexpr std::array all_icons = {Icon::none,   Icon::step,    Icon::play, Icon::pause, Icon::reset,
                                  Icon::cancel, Icon::warning, Icon::undo, Icon::redo};
constexpr float size = 20, apart = 50, first = 30;  // [px]
constexpr Colour colour{0.2, 0.4, 1.0};             // that nothing else has

/// All icons in a row.
struct IconPanel : PanelContent {
  void draw(const PanelContext&, const Rectangle& rectangle) override {
    const Panel panel("Icons", rectangle);
    for (std::size_t i = 0; i < all_icons.size(); ++i)
      draw_icon(all_icons[i], {float(rectangle.x) + first + apart * float(i), float(rectangle.y) + first}, size,
                to_imgui_u32(colour));
    corner = {float(rectangle.x) + first, float(rectangle.y) + first};
  }
  static inline ImVec2 corner;
};

using Shape = std::vector<std::pair<float, float>>;  ///< corners of its triangles, from the icon's centre [px]

/// What was drawn of an icon in a colour; soft edges are a pixel wider, and clear there.
Shape shape_of(Icon icon, const Colour& wanted = colour) {
  const auto index = std::size_t(std::ranges::find(all_icons, icon) - all_icons.begin());
  const float x = IconPanel::corner.x + apart * float(index), y = IconPanel::corner.y;
  Shape shape;
  const ImDrawData* data = ImGui::GetDrawData();
  for (int i = 0; i < data->CmdListsCount; ++i)
    for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer)
      if (v.col == to_imgui_u32(wanted) && std::abs(v.pos.x - x) < apart / 2 && std::abs(v.pos.y - y) < apart / 2)
        shape.emplace_back(v.pos.x - x, v.pos.y - y);
  std::ranges::sort(shape);
  return shape;
}

class Icons : public testing::Test {
 protected:
  Icons() {
    std::vector<PanelEntry> panels = standard_panels();
    panels.push_back({{"icons", "Icons", Side::bottom, "All of them."}, [] { return std::make_unique<IconPanel>(); }});
    desk_ = std::make_unique<Desk>(1280, 800, 1.0, panels);
    desk_->window.bring_to_front("icons");
    desk_->frames();
  }
  std::unique_ptr<Desk> desk_;
};

TEST_F(Icons, NoneIsNothingAndAllOthersFillTheirSquareEachWithAShapeOfItsOwn) {
  EXPECT_TRUE(shape_of(Icon::none).empty());
  std::set<Shape> shapes;
  for (const Icon icon : all_icons) {
    if (icon == Icon::none) continue;
    const Shape shape = shape_of(icon);
    ASSERT_FALSE(shape.empty()) << int(icon);
    EXPECT_TRUE(shapes.insert(shape).second) << int(icon) << " looks like another";
    float left = 0, right = 0, above = 0, beneath = 0;
    for (const auto& [x, y] : shape) {
      left = std::min(left, x), right = std::max(right, x), above = std::min(above, y), beneath = std::max(beneath, y);
      EXPECT_LT(std::max(std::abs(x), std::abs(y)), 0.75f * size) << int(icon);
    }
    EXPECT_TRUE(left < -0.2f * size && right > 0.2f * size && above < -0.2f * size && beneath > 0.2f * size)
        << int(icon);
  }
}

TEST_F(Icons, PlayIsATriangleThatPointsRightAndAStepEndsAtABar) {
  const Shape play = shape_of(Icon::play), step = shape_of(Icon::step);
  const auto at_right = [](const Shape& shape) {
    return std::ranges::count_if(shape, [&](const auto& p) { return p.first > shape.back().first - 0.5f; });
  };
  EXPECT_EQ(play.size(), 3u);
  EXPECT_EQ(at_right(play), 1) << "its tip";
  EXPECT_NEAR(play.back().second, 0.0f, 0.01f);
  EXPECT_EQ(step.size(), 3u + 4u);
  EXPECT_EQ(at_right(step), 2) << "the bar's right side";
}

TEST_F(Icons, APauseIsTwoBarsAndRedoTheMirrorImageOfUndo) {
  const Shape pause = shape_of(Icon::pause), undo = shape_of(Icon::undo);
  EXPECT_EQ(pause.size(), 8u);
  for (const auto& [x, y] : pause) EXPECT_GT(std::abs(x), 0.05f * size) << "free between them";
  float lean =
      0;  // of the arrow's head, which has as many corners left of the middle as it has in its mirror image right
  Shape mirrored;
  for (const auto& [x, y] : undo) mirrored.emplace_back(-x, y), lean += x;
  std::ranges::sort(mirrored);
  const Shape redo = shape_of(Icon::redo);
  float redo_lean = 0;
  for (const auto& [x, y] : redo) redo_lean += x;
  ASSERT_EQ(redo.size(), undo.size());
  EXPECT_NEAR(redo_lean, -lean, 0.5f);
  EXPECT_NE(undo, redo);
}

TEST_F(Icons, AWarningHasItsMarkInPaper) {
  EXPECT_GE(shape_of(Icon::warning, theme::paper).size(), 8u) << "a stroke and a dot";
  EXPECT_TRUE(shape_of(Icon::cancel, theme::paper).empty());
}

}  // namespace
}  // namespace nextview
