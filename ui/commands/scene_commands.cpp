#include "ui/commands/scene_commands.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/session/start_map.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

using Names = std::vector<std::string>;

/// A layer that is switched on and off.
CommandOf<> toggle(const char* layer, const char* text, char key_name, bool LayerChoice::*shown) {
  return {{std::string("toggle-") + layer,
           "Scene",
           std::string("Show ") + text,
           std::string("Shows or hides ") + text + ".",
           {{key(key_name)}},
           {},
           [shown](const WindowState& w) { return w.layers.*shown; }},
          [shown](CommandTarget& t) { t.window.layers.*shown = !(t.window.layers.*shown); }};
}

CommandOf<> toggle_voxels(const char* which, const char* help, bool VoxelFilter::*shown) {
  return {{std::string("toggle-") + which,
           "Scene",
           std::string("Voxels: ") + which,
           help,
           {},
           {},
           [shown](const WindowState& w) { return w.layers.voxels.*shown; }},
          [shown](CommandTarget& t) { t.window.layers.voxels.*shown = !(t.window.layers.voxels.*shown); }};
}

/// Which of an enumeration's ways to show something is taken; `names` are in its order.
template <class Enum>
CommandOf<Enum> choose(const char* name, const char* text, const char* help, const char* argument, const Names& names,
                       Enum LayerChoice::*member) {
  return {{name, "Scene", text, help},
          argument::choice<Enum>(argument, help, names),
          [member](CommandTarget& t, Enum chosen) { t.window.layers.*member = chosen; }};
}

std::string region_why_not(const CommandState& t) {
  const Configuration& c = t.session.configuration;
  const bool map_alone = !t.session.live && c.recorded.folder.empty() && is_map(c.object.file);
  return map_alone ? "a map alone has its own region" : needs_session(t);
}

/// Across an axis, in the middle of the region of interest at first, a tenth of it thick.
void slice_across(CommandTarget& t, SliceAxis chosen) {
  auto& slice = t.window.layers.voxels.slice;
  if (chosen == SliceAxis::none) return slice.reset();
  const int axis = static_cast<int>(chosen) - 1;
  const double low = t.session.grid.lower()[axis], high = t.session.grid.upper()[axis];
  const double middle = (low + high) / 2, half = std::max((high - low) / 64, t.session.grid.resolution);
  slice = Slice{axis, middle - half, middle + half};
}

void move_slice(CommandTarget& t, double position, std::optional<double> thickness) {
  Slice& slice = *t.window.layers.voxels.slice;
  const double half = 0.5 * thickness.value_or(slice.high - slice.low);
  slice.low = position - half;
  slice.high = position + half;
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

const CommandOf<> command::toggle_object = toggle("object", "the object", '1', &LayerChoice::object);
const CommandOf<> command::toggle_cloud = toggle("cloud", "the point cloud", '2', &LayerChoice::cloud);
const CommandOf<> command::toggle_octree = toggle("octree", "the octree", '3', &LayerChoice::octree);
const CommandOf<> command::toggle_views = toggle("views", "the candidate views and the path", '4', &LayerChoice::views);
const CommandOf<> command::toggle_rays =
    toggle("rays", "the rays of the view that is looked at", '5', &LayerChoice::rays);
const CommandOf<> command::toggle_region = toggle("region", "the region of interest", '6', &LayerChoice::region);
const CommandOf<> command::edit_region{
    {"edit-region",
     "Scene",
     "Drag the region of interest",
     "Shows or hides handles by which the mouse drags the region of interest (map.region); let go, it starts the scan "
     "over.",
     {},
     region_why_not,
     [](const WindowState& w) { return w.edit_region; }},
    [](CommandTarget& t) {
      t.window.edit_region = !t.window.edit_region;
      if (!t.window.edit_region) return;
      t.window.layers.region = true;  // with all of its handles
      t.window.camera_motions.push_back(camera_motion::Frame{Framed::region});
    }};
const CommandOf<> command::toggle_missed{
    {"toggle-missed",
     "Scene",
     "Show the missed surface, painted on the object",
     "Shows or hides the missed surface, painted on the object, without points and voxels in front of it.",
     {{key('7')}},
     {},
     [](const WindowState& w) { return w.layers.missed; }},
    [](CommandTarget& t) {
      LayerChoice& layers = t.window.layers;
      layers.missed = !layers.missed;
      layers.octree = !layers.missed;
      if (layers.missed) layers.cloud = false;
    }};

const CommandOf<> command::toggle_candidates =
    toggle("candidates", "all candidate views, not only the best five", '8', &LayerChoice::all_candidates);
const CommandOf<> command::toggle_legends = toggle("legends", "the legends of the colours", 'K', &LayerChoice::legends);

const CommandOf<MeshStyle> command::object_style =
    choose("object-style", "Draw the object…", "How the object is drawn.", "style", {"solid", "wire", "ghost"},
           &LayerChoice::object_style);
const CommandOf<CloudColouring> command::cloud_colour =
    choose("cloud-colour", "Colour the points…", "What the points' colours say.", "by",
           {"single", "view", "height", "distance"}, &LayerChoice::cloud_colouring);
const CommandOf<MapChoice> command::voxel_map =
    choose("voxel-map", "Voxels of which map…", "Which map the voxels are of: conventional or Gibbs.", "map",
           {"conventional", "gibbs"}, &LayerChoice::map);
const CommandOf<VoxelColouring> command::voxel_colour =
    choose("voxel-colour", "Colour the voxels…", "What the voxels' colours say.", "by",
           {"class", "probability", "entropy", "difference", "error"}, &LayerChoice::colouring);

const CommandOf<> command::toggle_occupied =
    toggle_voxels("occupied", "Shows or hides voxels of class occupied.", &VoxelFilter::occupied);
const CommandOf<> command::toggle_unknown = toggle_voxels(
    "unknown", "Shows or hides measured voxels that are neither occupied nor free.", &VoxelFilter::unknown);
const CommandOf<> command::toggle_free =
    toggle_voxels("free", "Shows or hides voxels of class free.", &VoxelFilter::free);
const CommandOf<> command::toggle_uncertain =
    toggle_voxels("uncertain", "Shows, instead of classes, the voxels of high entropy.", &VoxelFilter::uncertain);

const CommandOf<double> command::threshold{
    {"threshold", "Scene", "Unknown voxels from…", "Unknown voxels below this probability stay hidden."},
    argument::number("probability", "from 0 to 1", 0, 1),
    [](CommandTarget& t, double probability) { t.window.layers.voxels.unknown_from = probability; }};

const CommandOf<double> command::uncertain_from{
    {"uncertain-from", "Scene", "Uncertain voxels from…", "The entropy from which a voxel counts as uncertain."},
    argument::number("entropy", "[nats], up to ln 2 = 0.693", 0, 0.6931),
    [](CommandTarget& t, double entropy) { t.window.layers.voxels.entropy_from = entropy; }};

const CommandOf<SliceAxis> command::slice_axis{
    {"slice-axis",
     "Scene",
     "Slice across…",
     "Shows only a slice of the voxels, across an axis; none shows all.",
     {},
     needs_session},
    argument::choice<SliceAxis>("axis", "x, y, z or none", {"none", "x", "y", "z"}),
    slice_across};

const CommandOf<double, std::optional<double>> command::slice_at{
    {"slice-at",
     "Scene",
     "Move the slice…",
     "Moves the slice along its axis.",
     {},
     [](const CommandState& t) { return t.window.layers.voxels.slice ? "" : "choose an axis first (slice-axis)"; }},
    argument::number("position", "of its middle [m]", -100, 100),
    argument::optional(argument::number("thickness", "[m]", 1e-6, 100)),
    move_slice};

const CommandOf<> command::lock_ranges{
    {"lock-ranges",
     "Scene",
     "Lock the colour ranges",
     "Keeps the range of each colour legend from step to step.",
     {{key('L')}},
     {},
     [](const WindowState& w) { return w.layers.ranges_locked; }},
    [](CommandTarget& t) { t.window.layers.ranges_locked = !t.window.layers.ranges_locked; }};

}  // namespace nextview
