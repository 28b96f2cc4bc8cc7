#include "ui/demo/demo_window.hpp"

#include <fmt/format.h>

#include "ui/commands/command_list.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/window/window.hpp"

namespace nextview {

int show_demo(const Demo& demo) { return run_window({}, {demo.file.string(), demo.calls, true, true}); }

void print_demo_commands() {
  announce_panels(standard_panels());  // they have keys
  fmt::print("{}", command_table());
}

}  // namespace nextview
