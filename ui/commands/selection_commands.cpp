#include "ui/commands/selection_commands.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "core/setting/length_text.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"
#include "ui/workbench/inspection.hpp"
#include "ui/workbench/view_sight.hpp"

namespace nextview {
namespace {

using Kind = ViewSelection::Kind;

void show_view(WindowState& window, ViewSelection view) {
  if (window.selection.view != view) window.selection.ray.reset();
  window.selection.view = view;
}

std::vector<std::string> numbers(std::size_t first, std::size_t count) {
  std::vector<std::string> result;
  for (std::size_t i = first; i < first + count; ++i) result.push_back(std::to_string(i));
  return result;
}

std::vector<std::string> candidates(const SessionSnapshot& s) { return numbers(0, s.candidates.size()); }
std::vector<std::string> steps(const SessionSnapshot& s) { return numbers(1, s.records.size()); }

void look_at_candidate(CommandTarget& t, std::size_t candidate) {
  if (candidate >= t.session.candidates.size())
    throw std::invalid_argument("select-view: there are " + std::to_string(t.session.candidates.size()) +
                                " candidates, from 0");
  show_view(t.window, {Kind::candidate, candidate});
}

void look_at_taken(CommandTarget& t, std::size_t step) {
  if (step > t.session.records.size())
    throw std::invalid_argument("select-taken: " + std::to_string(t.session.records.size()) + " views were taken");
  show_view(t.window, {Kind::taken, step - 1});
}

void inspect_voxel_at(CommandTarget& t, double x, double y, double z) {
  const VoxelGrid& grid = t.session.grid;
  const Eigen::Vector3i cell = grid.cell_at({x, y, z});
  if (!grid.contains(cell)) throw std::invalid_argument("inspect-voxel: that is outside of the region of interest");
  t.window.selection.voxel = grid.index(cell);
  t.window.selection.ray.reset();
  t.window.bring_to_front(panel_name::inspector);
}

void inspect_ray_of(CommandTarget& t, std::size_t ray) {
  t.window.selection.ray = ray;
  t.window.selection.voxel.reset();
  t.window.bring_to_front(panel_name::inspector);
}

/// As the scene is looked at now, moved to where the sensor is of use.
Pose view_of_scene(CommandTarget& t) {
  const PlacedView placed = within_sight(t.session, t.window.scene_camera);
  if (std::abs(placed.moved) > 0.005) {
    const std::string reason = why_empty(t.session, t.window.scene_camera);
    t.worker.log().add(LogEntry::Level::success,
                       fmt::format("Your view is moved {} {} along the line of sight: {}",
                                   length_text(std::abs(placed.moved)), placed.moved > 0 ? "forward" : "back",
                                   reason.empty() ? "from there the sensor measures more than twice as much" : reason));
  }
  return placed.T_world_camera;
}

using Metres = std::optional<double>;

/// A custom view: from and towards the given points, or as the scene is looked at now.
void set_up_custom_view(CommandTarget& t, Metres x, Metres y, Metres z, Metres to_x, Metres to_y, Metres to_z) {
  Pose T_world_camera;
  if (!x) {
    T_world_camera = view_of_scene(t);
  } else {
    if (!to_z) throw std::invalid_argument("custom-view takes either nothing or all six numbers");
    const Vector3 from(*x, *y, *z), to(*to_x, *to_y, *to_z);
    if ((from - to).norm() < 1e-6) throw std::invalid_argument("custom-view: the camera stands where it looks at");
    T_world_camera = look_at(from, to);
  }
  if (const std::string reason = why_empty(t.session, T_world_camera); !reason.empty())
    t.worker.log().add(LogEntry::Level::warning, "Your view would measure nothing: " + reason);
  t.window.selection.custom_view = T_world_camera;
  show_view(t.window, {Kind::custom, 0});
  t.window.bring_to_front(panel_name::view);
}

ArgumentOf<double> metres(const char* name, const char* help) { return argument::number(name, help, -1e4, 1e4); }
ArgumentOf<Metres> own(const char* name, const char* help) { return argument::optional(metres(name, help)); }

}  // namespace

const CommandOf<std::size_t> command::select_view{
    {"select-view",
     "Select",
     "Look at a candidate…",
     "Shows a candidate's frustum, its rays and what the camera would see from there.",
     {},
     needs_session},
    argument::whole("candidate", "its number", 0, 1e6, candidates),
    look_at_candidate};

const CommandOf<std::size_t> command::select_taken{
    {"select-taken",
     "Select",
     "Look at a view that was taken…",
     "Shows what a view measured, and its gain as predicted and as realised.",
     {},
     needs_view},
    argument::whole("step", "the first is 1", 1, 1e6, steps),
    look_at_taken};

const CommandOf<> command::select_next{{"select-next",
                                        "Select",
                                        "Look at the next view",
                                        "Shows the view that is taken next.",
                                        {{key('N')}},
                                        needs_session},
                                       [](CommandTarget& t) { show_view(t.window, {}); }};

const CommandOf<Metres, Metres, Metres, Metres, Metres, Metres> command::custom_view{
    {"custom-view",
     "Select",
     "Set up a custom view",
     "Looks at a view from where the scene is looked at, or from a point towards another; take-custom-view takes it.",
     {{key('V')}},
     needs_session},
    own("x", "from [m]"),
    own("y", "from [m]"),
    own("z", "from [m]"),
    own("to_x", "towards [m]"),
    own("to_y", "towards [m]"),
    own("to_z", "towards [m]"),
    set_up_custom_view};

const CommandOf<> command::look_through{
    {"look-through",
     "Select",
     "Look through this view",
     "Brings the scene's camera to where the view that is looked at has its own.",
     {{key('C')}},
     needs_session},
    [](CommandTarget& t) {
      t.window.camera_motions.push_back(
          camera_motion::LookThrough{selected_view_pose(t.session, t.window.selection).value_or(t.session.next_view)});
    }};

const CommandOf<double, double, double> command::inspect_voxel{
    {"inspect-voxel",
     "Select",
     "Inspect a voxel…",
     "Shows a voxel's probability, history, rays and Gibbs conditional. Or click on it.",
     {},
     needs_session},
    metres("x", "of a point in it [m]"),
    metres("y", "of a point in it [m]"),
    metres("z", "of a point in it [m]"),
    inspect_voxel_at};

const CommandOf<std::size_t> command::inspect_ray{
    {"inspect-ray",
     "Select",
     "Inspect a ray…",
     "Shows the voxels along a ray of the view that is looked at, and what each contributes.",
     {},
     needs_view},
    argument::whole("ray", "its number, row by row", 0, 1e6),
    inspect_ray_of};

const CommandOf<> command::clear_selection{
    {"clear-selection",
     "Select",
     "Select nothing",
     "Leaves voxel, ray, view, the handles of the region and what is measured alone.",
     {{Key::escape}}},
    [](CommandTarget& t) {
      t.window.selection = {};
      t.window.edit_region = false;
      t.window.measurement.reset();
    }};

CommandCall with_numbers(const CommandCall& call, CommandTarget& target) {
  const bool is_wanted = call.command == &command::custom_view && call.values().empty();
  if (!is_wanted || !call.command->available(target.state())) return call;
  const Pose T_world_camera = view_of_scene(target);
  const Vector3 from = T_world_camera.translation(), to = from + T_world_camera.linear().col(2);
  CommandCall result = command::custom_view(from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
  result.line = call.line;
  return result;
}

}  // namespace nextview
