// Demos in a window on a display.
#include <gtest/gtest.h>

#include <sstream>

#include "core/file/atomic_file.hpp"
#include "core/file/installation.hpp"
#include "tests/integration/demo_in_window.hpp"
#include "tests/render/virtual_display.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {
namespace {

class DemosOnADisplay : public InTemporaryFolder {
 protected:
  /// Of a window of this size under Xvfb.
  std::vector<std::string> hashes_of_window(const std::string& demo, const std::string& size, int frames_per_second) {
    const VirtualDisplay display;
    EXPECT_TRUE(display.ready()) << "Xvfb does not start; install xvfb";
    std::error_code error;
    const std::string self = running_program(error).string(), file = (folder_ / "hashes").string();
    EXPECT_EQ(exit_status(start({"env", "DISPLAY=" + display.name(), self, "--play-in-window", demo, size,
                                 std::to_string(frames_per_second), file})),
              0);
    std::vector<std::string> hashes;
    std::istringstream lines(read_file(file));
    for (std::string line; std::getline(lines, line);) hashes.push_back(line);
    return hashes;
  }
};

/// NEXTVIEW_DEMO names another one than this short one: the tour takes half a minute.
TEST_F(DemosOnADisplay, HaveTheFramesThatTheyHaveWithoutOne) {
  announce_panels(standard_panels());
  const char* const wanted = std::getenv("NEXTVIEW_DEMO");
  const std::string file = (folder_ / "short.nextview").string();
  write_file(file,
             "hide-panels\nopen sphere\nset sensor.width 80\nset sensor.height 60\nset map.resolution 0.04\n"
             "set views.count 8\ncaption One\norbit 90 1 10\nstep\nwait until done\nhide-panels\nhighlight view 1\n"
             "wait until done\ntitle End 0.5\nwait until done\n");
  const std::string demo = wanted ? wanted : file;
  const auto headless = frame_hashes(read_demo(demo), {{640, 360}, 4});
  const auto window = hashes_of_window(demo, "640x360", 4);
  ASSERT_EQ(window.size(), headless.size());
  EXPECT_GE(headless.size(), 10u);
  for (std::size_t i = 0; i < headless.size(); ++i) EXPECT_EQ(window[i], headless[i]) << "frame " << i + 1;
}

}  // namespace
}  // namespace nextview
