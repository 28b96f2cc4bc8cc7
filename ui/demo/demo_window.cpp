#include "ui/demo/demo_window.hpp"

#include "ui/commands/command_list.hpp"
#include "ui/window/window.hpp"

namespace nextview {

int show_demo(const Demo& demo) { return run_window({}, {demo.file.string(), demo.calls, true, true}); }

std::string demo_commands() { return command_table(); }

}  // namespace nextview
