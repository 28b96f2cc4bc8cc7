#include "ui/commands/scene_commands.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

/// Across an axis, through the middle of the object at first; what is nearer to the camera goes.
void section_across(CommandTarget& t, const std::optional<SliceAxis>& chosen) {
  auto& section = t.window.layers.section;
  const SliceAxis wanted = chosen.value_or(section ? SliceAxis::none : SliceAxis::x);
  if (wanted == SliceAxis::none) return section.reset();
  const int axis = static_cast<int>(wanted) - 1;
  const double middle = t.session.object_box.center()[axis];
  section = Section{axis, middle, t.window.scene_camera.translation()[axis] < middle};
}

std::string needs_section(const CommandState& t) {
  return t.window.layers.section ? "" : "choose an axis first (section-axis)";
}

std::vector<std::string> camera_names(const SessionSnapshot& s) {
  std::vector<std::string> names;
  if (s.cameras)
    for (const CameraBookmark& camera : *s.cameras) names.push_back(camera.name);
  return names;
}

std::string needs_camera(const CommandState& t) {
  return camera_names(t.session).empty() ? "no camera is kept yet (keep-camera)" : "";
}

void go_to(CommandTarget& t, const std::string& name) {
  const auto& cameras = *t.session.cameras;
  const auto found = std::ranges::find(cameras, name, &CameraBookmark::name);
  if (found == cameras.end()) throw std::invalid_argument("go-to-camera: there is no camera '" + name + "'");
  t.window.camera_motions.push_back(camera_motion::GoTo{found->T_world_camera});
}

}  // namespace

const CommandOf<std::optional<Framed>> command::frame{
    {"frame",
     "Scene",
     "Frame",
     "Brings the object, all that is shown, or the region of interest into the middle of the scene, as near as it "
     "fits.",
     {{key('F')}, {key('A'), false, {"all"}}}},
    argument::optional(argument::choice<Framed>("what", "the object if nothing is said", {"object", "all", "region"})),
    [](CommandTarget& t, const std::optional<Framed>& what) {
      t.window.camera_motions.push_back(camera_motion::Frame{what.value_or(Framed::object)});
    }};

const CommandOf<double, double> command::look_from{
    {"look-from", "Scene", "Look from…", "Frames the object, seen from this direction."},
    argument::number("azimuth", "from x towards y [deg]", -360, 360),
    argument::number("elevation", "above the horizon [deg]", -89, 89),
    [](CommandTarget& t, double azimuth, double elevation) {
      t.window.camera_motions.push_back(camera_motion::LookFrom{azimuth, elevation});
    }};

const CommandOf<StandardView> command::standard_view{
    {"standard-view",
     "Scene",
     "Look from a side…",
     "Frames the object, seen along an axis, or from above at an angle as at first.",
     {{key('1'), true, {"front"}},
      {key('2'), true, {"right"}},
      {key('3'), true, {"back"}},
      {key('4'), true, {"left"}},
      {key('5'), true, {"top"}},
      {key('6'), true, {"bottom"}},
      {key('7'), true, {"usual"}}}},
    argument::choice<StandardView>("side", "front is where y is negative",
                                   {"front", "right", "back", "left", "top", "bottom", "usual"}),
    [](CommandTarget& t, StandardView side) {
      if (side == StandardView::usual) return t.window.camera_motions.push_back(camera_motion::Frame{});
      // Straight from above or below there would be no upright.
      constexpr std::array<std::pair<double, double>, 6> directions{
          {{-90, 0}, {0, 0}, {90, 0}, {180, 0}, {-90, 89.9}, {-90, -89.9}}};
      const auto [azimuth, elevation] = directions[static_cast<std::size_t>(side)];
      t.window.camera_motions.push_back(camera_motion::LookFrom{azimuth, elevation});
    }};

const CommandOf<double, double> command::turn{
    {"turn",
     "Scene",
     "Turn the scene…",
     "Turns the scene's camera around the object.",
     {{Key::left, false, {"-10", "0"}},
      {Key::right, false, {"10", "0"}},
      {Key::up, false, {"0", "10"}},
      {Key::down, false, {"0", "-10"}}},
     {},
     {},
     true},
    argument::number("azimuth", "to the right [deg]", -360, 360),
    argument::number("elevation", "up [deg]", -180, 180),
    [](CommandTarget& t, double azimuth, double elevation) {
      t.window.camera_motions.push_back(camera_motion::Turn{azimuth, elevation});
    }};

const CommandOf<double> command::zoom{
    {"zoom",
     "Scene",
     "Nearer or farther…",
     "Moves the scene's camera nearer; negative steps move it away.",
     {{key('='), false, {"1"}}, {key('-'), false, {"-1"}}},
     {},
     {},
     true},
    argument::number("steps", "of an eighth of the distance", -100, 100),
    [](CommandTarget& t, double steps) { t.window.camera_motions.push_back(camera_motion::Zoom{steps}); }};

const CommandOf<std::optional<SliceAxis>> command::section_axis{
    {"section-axis",
     "Scene",
     "Cut open, or close",
     "Cuts object, surface, points and voxels open across an axis, the object's inside hatched; none leaves all whole. "
     "Without an axis: across x, or closed again.",
     {{key('X')}},
     needs_session},
    argument::optional(argument::choice<SliceAxis>(
        "axis", "x, y, z or none; if nothing is said none, or x where all is whole", {"none", "x", "y", "z"})),
    section_across};

const CommandOf<double> command::section_at{
    {"section-at", "Scene", "Move the section…", "Moves the section along its axis.", {}, needs_section},
    argument::number("position", "[m]", -100, 100),
    [](CommandTarget& t, double position) { t.window.layers.section->at = position; }};

const CommandOf<> command::flip_section{
    {"flip-section", "Scene", "Turn the section over", "Cuts off the other half.", {}, needs_section},
    [](CommandTarget& t) { t.window.layers.section->keeps_upper = !t.window.layers.section->keeps_upper; }};

const CommandOf<SecondView> command::second_view{
    {"second-view",
     "Scene",
     "Show beside it…",
     "Shows one thing of the scan in a second scene, which the same camera looks at; none: no second scene.",
     {},
     needs_session},
    argument::choice<SecondView>("what", "gibbs is the Gibbs map's octree",
                                 {"none", "object", "surface", "cloud", "octree", "gibbs", "missed"}),
    [](CommandTarget& t, SecondView what) { t.window.layers.second = what; }};

const CommandOf<> command::toggle_orthographic{
    {"toggle-orthographic",
     "Scene",
     "Without vanishing points",
     "Draws the scene without perspective, or with it again: what is equally long looks so wherever it is.",
     {{key('O')}},
     {},
     [](const WindowState& w) { return w.orthographic; }},
    [](CommandTarget& t) { t.window.orthographic = !t.window.orthographic; }};

const CommandOf<std::string> command::keep_camera{
    {"keep-camera",
     "Scene",
     "Keep this camera…",
     "Keeps where the scene is looked at from, with the session, to come back to by go-to-camera.",
     {},
     needs_session},
    argument::text("name", "of it; one that there is takes this place", camera_names),
    [](CommandTarget& t, const std::string& name) {
      t.worker.post(request::KeepCamera{{name, t.window.scene_camera}});
    }};

const CommandOf<std::string> command::go_to_camera{
    {"go-to-camera", "Scene", "Go to a kept camera…", "Looks at the scene from there again.", {}, needs_camera},
    argument::text("name", "of a camera that was kept", camera_names),
    go_to};

const CommandOf<std::string> command::remove_camera{
    {"remove-camera", "Scene", "Remove a kept camera…", "Keeps that camera no longer.", {}, needs_camera},
    argument::text("name", "of a camera that was kept", camera_names),
    [](CommandTarget& t, const std::string& name) { t.worker.post(request::RemoveCamera{name}); }};

}  // namespace nextview
