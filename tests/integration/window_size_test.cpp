// The window at any size.
#include <gtest/gtest.h>

#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"

namespace nextview {
namespace {

/// Small windows fold their panels; nothing ends the program, and each panel can be reached.
TEST(Window, WorksAtAnySize) {
  for (const auto& [width, height, scale] : {std::tuple{640, 480, 1.0},
                                             {200, 150, 1.0},
                                             {300, 720, 1.0},
                                             {1400, 200, 1.0},
                                             {640, 480, 2.0},
                                             {8, 8, 1.0},
                                             {1, 1, 1.0}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    User user(small_scan(), width, height, scale);
    user.run_quickly("step\ncustom-view\nlook-through\nframe\n");
    for (const std::string& panel : panel_names()) user.run_quickly("panel " + panel + "\n");
    user.run(
        "inspect-voxel 0 0 0\nshortcuts\nshortcuts\npalette\npalette\nlook-from 30 20\nzoom "
        "1\nundo\nundo\nundo\nstep\n");
    user.move(width / 2.0, height / 2.0);
    user.press();
    user.move(width / 2.0 + 3, height / 2.0 + 2);
    user.release();
    user.wait();
    EXPECT_EQ(user.session().records.size(), 1u);
    EXPECT_EQ(user.target().gl_error(), 0u);
  }
}

/// Who enlarges text keeps Step, Play and Undo, and has it larger in a larger window.
TEST(Window, TextGrowsAsFarAsTheControlBarHasRoom) {
  for (const auto& [width, height] : {std::pair{640, 480}, {480, 360}, {1280, 800}}) {
    User user(tiny_scan(), width, height);
    const double usual = user.window().layout().control_bar.height;
    for (int i = 0; i < 5; ++i) user.run_quickly("text-size bigger\n");
    const double bar = user.window().layout().control_bar.height;
    EXPECT_GT(bar, 1.2 * usual) << width;
    EXPECT_LE(bar / usual * 332, width);
    if (width >= 1280) {
      EXPECT_LE(bar / usual * 400, height) << "no panel has room for its table";
    }
  }
}

TEST(Window, PanelsNeverOverlap) {
  for (const auto& [width, height, scale, open] : {std::tuple{1200, 720, 1.0, Side::right},
                                                   {1280, 800, 1.0, Side::left},
                                                   {2560, 1600, 2.0, Side::right},
                                                   {3840, 2160, 1.5, Side::right},
                                                   {640, 480, 1.0, Side::right},
                                                   {640, 480, 1.0, Side::left},
                                                   {640, 480, 1.0, Side::bottom},
                                                   {640, 480, 2.0, Side::left},
                                                   {1000, 480, 1.0, Side::bottom},
                                                   {800, 900, 1.0, Side::left},
                                                   {480, 360, 1.0, Side::bottom},
                                                   {200, 150, 1.0, Side::left},
                                                   {200, 150, 2.0, Side::right},
                                                   {40, 30, 1.0, Side::right},
                                                   {1, 1, 1.0, Side::right}}) {
    const Layout l(width, height, scale, open);
    std::vector<Rectangle> all{l.menu, l.control_bar, l.left, l.right, l.bottom, l.scene, l.status};
    std::erase_if(all, [](const Rectangle& r) { return r.empty(); });
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_GE(all[i].x, 0.0);
      EXPECT_GE(all[i].y, 0.0);
      EXPECT_LE(all[i].x + all[i].width, width);
      EXPECT_LE(all[i].y + all[i].height, height);
      for (std::size_t j = 0; j < i; ++j) {
        const bool apart = all[i].x >= all[j].x + all[j].width || all[j].x >= all[i].x + all[i].width ||
                           all[i].y >= all[j].y + all[j].height || all[j].y >= all[i].y + all[i].height;
        EXPECT_TRUE(apart) << i << " and " << j << " at " << width << " x " << height;
      }
    }
  }
}

}  // namespace
}  // namespace nextview
