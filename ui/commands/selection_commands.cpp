#include <fmt/format.h>

#include <cmath>

#include "ui/commands/command_list.hpp"
#include "ui/workbench/inspection.hpp"
#include "ui/workbench/view_sight.hpp"

namespace nextview {
namespace {

using Kind = LookedAt::Kind;

void look_at_view(WindowState& window, LookedAt view) {
  if (window.selection.view != view) window.selection.ray.reset();
  window.selection.view = view;
}

std::vector<std::string> numbers(std::size_t first, std::size_t count) {
  std::vector<std::string> result;
  for (std::size_t i = first; i < first + count; ++i) result.push_back(std::to_string(i));
  return result;
}

void select_view(CommandTarget& t, const Arguments& a) {
  if (a.whole(0) >= t.session.candidates.size())
    throw std::invalid_argument("select-view: there are " + std::to_string(t.session.candidates.size()) +
                                " candidates, from 0");
  look_at_view(t.window, {Kind::candidate, a.whole(0)});
}

void select_taken(CommandTarget& t, const Arguments& a) {
  if (a.whole(0) > t.session.records.size())
    throw std::invalid_argument("select-taken: " + std::to_string(t.session.records.size()) + " views were taken");
  look_at_view(t.window, {Kind::taken, a.whole(0) - 1});
}

void inspect_voxel(CommandTarget& t, const Arguments& a) {
  const VoxelGrid& grid = t.session.grid;
  const Eigen::Vector3i cell = grid.cell_at({a.number(0), a.number(1), a.number(2)});
  if (!grid.contains(cell)) throw std::invalid_argument("inspect-voxel: that is outside of the region of interest");
  t.window.selection.voxel = grid.index(cell);
  t.window.selection.ray.reset();
  t.window.bring_to_front(PanelName::inspector);
}

void inspect_ray(CommandTarget& t, const Arguments& a) {
  t.window.selection.ray = a.whole(0);
  t.window.selection.voxel.reset();
  t.window.bring_to_front(PanelName::inspector);
}

/// A view of one's own: from and towards the given points, or as the scene is looked at now.
void own_view(CommandTarget& t, const Arguments& a) {
  PlacedView placed;
  if (a.count() == 0) {
    placed = within_sight(t.session, t.window.scene_camera);
    if (std::abs(placed.moved) > 0.005)
      t.worker.log().add(
          LogEntry::Level::success,
          fmt::format("Your view is moved {:.2f} m {} along the line of sight: {}", std::abs(placed.moved),
                      placed.moved > 0 ? "forward" : "back", why_empty(t.session, t.window.scene_camera)));
  } else {
    if (a.count() < 6) throw std::invalid_argument("own-view takes either nothing or all six numbers");
    const Vector3 from(a.number(0), a.number(1), a.number(2)), to(a.number(3), a.number(4), a.number(5));
    if ((from - to).norm() < 1e-6) throw std::invalid_argument("own-view: the camera stands where it looks at");
    placed.T_world_camera = look_at(from, to);
  }
  if (const std::string reason = why_empty(t.session, placed.T_world_camera); !reason.empty())
    t.worker.log().add(LogEntry::Level::warning, "Your view would measure nothing: " + reason);
  t.window.selection.own_view = placed.T_world_camera;
  look_at_view(t.window, {Kind::own, 0});
  t.window.bring_to_front(PanelName::view);
}

}  // namespace

std::vector<Command> selection_commands() {
  const auto metres = [](const char* name, const char* help) {
    return Argument{name, Argument::Kind::number, help, -100, 100};
  };
  const auto own = [](const char* name, const char* help) {
    return Argument{name, Argument::Kind::number, help, -100, 100, {}, true};
  };
  return {
      {"select-view",
       "Select",
       "Look at a candidate…",
       "Shows a candidate's frustum, its rays and what the camera would see from there.",
       {{"candidate", Argument::Kind::whole, "its number", 0, 1e6,
         [](const SessionSnapshot& s) { return numbers(0, s.candidates.size()); }}},
       {},
       select_view,
       needs_session},
      {"select-taken",
       "Select",
       "Look at a view that was taken…",
       "Shows what a view measured, and its gain as predicted and as realised.",
       {{"step", Argument::Kind::whole, "the first is 1", 1, 1e6,
         [](const SessionSnapshot& s) { return numbers(1, s.records.size()); }}},
       {},
       select_taken,
       needs_view},
      {"select-next",
       "Select",
       "Look at the next view",
       "Shows the view that is taken next.",
       {},
       {{key('N')}},
       [](CommandTarget& t, const Arguments&) { look_at_view(t.window, {}); },
       needs_session},
      {"own-view",
       "Select",
       "Set up a view of your own",
       "Looks at a view from where the scene is looked at, or from a point towards another; take-own-view takes it.",
       {own("x", "from [m]"), own("y", "from [m]"), own("z", "from [m]"), own("to_x", "towards [m]"),
        own("to_y", "towards [m]"), own("to_z", "towards [m]")},
       {{key('V')}},
       own_view,
       needs_session},
      {"look-through",
       "Select",
       "Look through this view",
       "Brings the scene's camera to where the view that is looked at has its own.",
       {},
       {{key('C')}},
       [](CommandTarget& t, const Arguments&) {
         t.window.camera_motions.push_back(
             camera_motion::LookThrough{looked_at_pose(t.session, t.window.selection).value_or(t.session.next_view)});
       },
       needs_session},
      {"inspect-voxel",
       "Select",
       "Inspect a voxel…",
       "Shows a voxel's probability, history, rays and Gibbs conditional. Or click on it.",
       {metres("x", "of a point in it [m]"), metres("y", "of a point in it [m]"), metres("z", "of a point in it [m]")},
       {},
       inspect_voxel,
       needs_session},
      {"inspect-ray",
       "Select",
       "Inspect a ray…",
       "Shows the voxels along a ray of the view that is looked at, and what each contributes.",
       {{"ray", Argument::Kind::whole, "its number, row by row", 0, 1e6}},
       {},
       inspect_ray,
       needs_view},
      {"clear-selection",
       "Select",
       "Select nothing",
       "Leaves voxel, ray and view alone.",
       {},
       {{Key::escape}},
       [](CommandTarget& t, const Arguments&) { t.window.selection = {}; }},
  };
}

}  // namespace nextview
