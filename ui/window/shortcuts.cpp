#include "ui/window/shortcuts.hpp"

#include <algorithm>
#include <array>

namespace nextview {
namespace {

constexpr std::array list = {
    Shortcut{Action::step, key('S'), false, "S", "take the next view"},
    Shortcut{Action::step, Key::space, false, "Space", "take the next view"},
    Shortcut{Action::play, key('P'), false, "P", "step until the scan is finished; pause"},
    Shortcut{Action::reset, key('R'), false, "R", "start over"},
    Shortcut{Action::frame, key('F'), false, "F", "frame all that is shown"},
    Shortcut{Action::toggle_object, key('1'), false, "1", "show or hide the object"},
    Shortcut{Action::toggle_cloud, key('2'), false, "2", "show or hide the point cloud"},
    Shortcut{Action::toggle_octree, key('3'), false, "3", "show or hide the octree"},
    Shortcut{Action::toggle_views, key('4'), false, "4", "show or hide the candidate views"},
    Shortcut{Action::toggle_rays, key('5'), false, "5", "show or hide the next view's rays"},
    Shortcut{Action::toggle_region, key('6'), false, "6", "show or hide the region of interest"},
    Shortcut{Action::show_shortcuts, Key::f1, false, "F1", "show or hide this sheet"},
    Shortcut{Action::quit, key('Q'), true, "Ctrl+Q", "quit"},
};

}  // namespace

std::span<const Shortcut> shortcuts() { return list; }

std::string_view keys_of(Action action) {
  return std::find_if(list.begin(), list.end(), [&](const Shortcut& s) { return s.action == action; })->keys;
}

}  // namespace nextview
