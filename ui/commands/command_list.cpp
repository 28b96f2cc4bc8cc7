#include "ui/commands/command_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "ui/commands/branch_commands.hpp"
#include "ui/commands/demo_commands.hpp"
#include "ui/commands/export_commands.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/gibbs_commands.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/commands/measure_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/scanner_commands.hpp"
#include "ui/commands/scene_commands.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {

std::span<const std::reference_wrapper<const Command>> commands() {
  using namespace command;
  static const std::vector<std::reference_wrapper<const Command>> all = {
      // File
      open, set, reset_setting, reset_settings, connect, disconnect, reconnect, export_scan, export_cloud, export_map,
      export_surface, export_views, export_curves, export_picture, export_turntable, save_picture, save_script, quit,
      // Scan
      step, play, go_on, pause, speed, take_view, take_proposal, take_custom_view, answer, cancel, undo, redo, reset,
      // Timeline
      previous_view, next_view, go_to_view, branch, go_to_branch, rename_branch, remove_branch, compare, stop_comparing,
      // Gibbs
      refine, pause_refinement, resume_refinement,
      // Select
      select_view, select_taken, select_next, custom_view, look_through, inspect_voxel, inspect_ray, measure,
      measure_point, clear_selection,
      // Scene
      frame, look_from, standard_view, turn, zoom, toggle_orthographic, keep_camera, go_to_camera, remove_camera,
      section_axis, section_at, flip_section, second_view,
      // Layers
      toggle_object, toggle_cloud, toggle_octree, toggle_views, toggle_rays, toggle_region, edit_region, toggle_missed,
      toggle_candidates, toggle_surface, toggle_legends, object_style, surface_source, surface_colour, cloud_colour,
      voxel_map, voxel_colour, toggle_occupied, toggle_unknown, toggle_free, toggle_uncertain, threshold,
      uncertain_from, slice_axis, slice_at, lock_ranges,
      // Window
      panel, curves, forget_runs, dismiss, sort, dark, text_size, panel_sizes, hide_panels, full_screen, palette,
      file_dialog,
      // Demo
      play_demo, record, record_stop, caption, title, highlight, orbit, fly_to, split, wait, assert_that,
      // Help
      guide, shortcuts, manual};
  return all;
}

std::vector<std::string> menus() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    if (std::find(names.begin(), names.end(), command.menu) == names.end()) names.push_back(command.menu);
  return names;
}

const Command& find_command(std::string_view name) {
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  throw std::invalid_argument(fmt::format("there is no command '{}'{}", name,
                                          did_you_mean(std::string(name), names, "; see nextview help commands")));
}

std::string command_table() {
  std::string table = "| command | key | does |\n|---|---|---|\n";
  for (const Command& command : commands()) {
    std::string keys;
    for (const Shortcut& s : command.shortcuts())
      keys += fmt::format("{}{}{}", keys.empty() ? "" : ", ", s.text(),
                          s.values.empty() ? "" : fmt::format(" ({})", fmt::join(s.values, " ")));
    table += fmt::format("| `{}` | {} | {} |\n", command.usage(), keys, command.help);
  }
  return table;
}

}  // namespace nextview
