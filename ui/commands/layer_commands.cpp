#include "ui/commands/layer_commands.hpp"

#include <algorithm>

#include "core/config/opened_input.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

using Names = std::vector<std::string>;

/// A layer that is switched on and off.
CommandOf<> toggle(const char* layer, const char* text, char key_name, bool LayerChoice::*shown) {
  return {{std::string("toggle-") + layer,
           "Layers",
           std::string("Show ") + text,
           std::string("Shows or hides ") + text + ".",
           {{key(key_name)}},
           {},
           [shown](const WindowState& w) { return w.layers.*shown; }},
          [shown](CommandTarget& t) { t.window.layers.*shown = !(t.window.layers.*shown); }};
}

CommandOf<> toggle_voxels(const char* which, const char* help, bool VoxelFilter::*shown) {
  return {{std::string("toggle-") + which,
           "Layers",
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
  return {{name, "Layers", text, help},
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

/// A surface that would be hidden by what lies in front of it.
CommandOf<> toggle_surface_alone(const std::string& what, const std::string& words, char letter,
                                 bool LayerChoice::*shown,
                                 std::function<std::string(const CommandState&)> why_not = {}) {
  return {{"toggle-" + what,
           "Layers",
           "Show " + words,
           "Shows or hides " + words + ", without points and voxels in front of it.",
           {{key(letter)}},
           std::move(why_not),
           [shown](const WindowState& w) { return w.layers.*shown; }},
          [shown](CommandTarget& t) { t.window.layers.show_alone(shown, !(t.window.layers.*shown)); }};
}

void move_slice(CommandTarget& t, double position, std::optional<double> thickness) {
  Slice& slice = *t.window.layers.voxels.slice;
  const double half = 0.5 * thickness.value_or(slice.high - slice.low);
  slice.low = position - half;
  slice.high = position + half;
}

}  // namespace

const CommandOf<> command::toggle_object = toggle("object", "the object", '1', &LayerChoice::object);
const CommandOf<> command::toggle_cloud = toggle("cloud", "the point cloud", '2', &LayerChoice::cloud);
const CommandOf<> command::toggle_octree = toggle("octree", "the octree", '3', &LayerChoice::octree);
const CommandOf<> command::toggle_views = toggle("views", "the candidate views and the path", '4', &LayerChoice::views);
const CommandOf<> command::toggle_rays =
    toggle("rays", "the rays of the view that is looked at", '5', &LayerChoice::rays);
const CommandOf<> command::toggle_region = toggle("region", "the region of interest", '6', &LayerChoice::region);
const CommandOf<> command::edit_region{
    {"edit-region",
     "Layers",
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
const CommandOf<> command::toggle_missed =
    toggle_surface_alone("missed", "the missed surface, painted on the object", '7', &LayerChoice::missed);
const CommandOf<> command::toggle_surface = toggle_surface_alone(
    "surface", "the reconstructed surface and its errors", '9', &LayerChoice::surface, [](const CommandState& t) {
      return t.session.compared ? "it is not made of two branches: stop comparing first" : "";
    });

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
    "unknown",
    "Shows or hides measured voxels that are neither occupied nor free: too few rays hit them to be sure, or others "
    "passed. More views (Continue), or refining the map, settle most.",
    &VoxelFilter::unknown);
const CommandOf<> command::toggle_free =
    toggle_voxels("free", "Shows or hides voxels of class free.", &VoxelFilter::free);
const CommandOf<> command::toggle_uncertain =
    toggle_voxels("uncertain", "Shows, instead of classes, the voxels of high entropy.", &VoxelFilter::uncertain);

const CommandOf<double> command::threshold{
    {"threshold", "Layers", "Unknown voxels from…", "Unknown voxels below this probability stay hidden."},
    argument::number("probability", "from 0 to 1", 0, 1),
    [](CommandTarget& t, double probability) { t.window.layers.voxels.unknown_from = probability; }};

const CommandOf<double> command::uncertain_from{
    {"uncertain-from", "Layers", "Uncertain voxels from…", "The entropy from which a voxel counts as uncertain."},
    argument::number("entropy", "[nats], up to ln 2 = 0.693", 0, 0.6931),
    [](CommandTarget& t, double entropy) { t.window.layers.voxels.entropy_from = entropy; }};

const CommandOf<SliceAxis> command::slice_axis{
    {"slice-axis",
     "Layers",
     "Slice across…",
     "Shows only a slice of the voxels, across an axis; none shows all.",
     {},
     needs_session},
    argument::choice<SliceAxis>("axis", "x, y, z or none", {"none", "x", "y", "z"}),
    slice_across};

const CommandOf<double, std::optional<double>> command::slice_at{
    {"slice-at",
     "Layers",
     "Move the slice…",
     "Moves the slice along its axis.",
     {},
     [](const CommandState& t) { return t.window.layers.voxels.slice ? "" : "choose an axis first (slice-axis)"; }},
    argument::number("position", "of its middle [m]", -100, 100),
    argument::optional(argument::number("thickness", "[m]", 1e-6, 100)),
    move_slice};

const CommandOf<SurfaceSource> command::surface_source =
    choose("surface-of", "Make the surface of…", "What the reconstructed surface is made of.", "source",
           {"map", "cloud"}, &LayerChoice::surface_source);
const CommandOf<SurfaceColouring> command::surface_colour = choose(
    "surface-colour", "Colour the surface…",
    "What the reconstructed surface's colours say: how far it lies from the true one, how far it may lie off, or "
    "only what was seen of it.",
    "by", {"deviation", "uncertainty", "single"}, &LayerChoice::surface_colouring);

const CommandOf<> command::lock_ranges{
    {"lock-ranges",
     "Layers",
     "Lock the colour ranges",
     "Keeps the range of each colour legend from step to step.",
     {{key('L')}},
     {},
     [](const WindowState& w) { return w.layers.ranges_locked; }},
    [](CommandTarget& t) { t.window.layers.ranges_locked = !t.window.layers.ranges_locked; }};

}  // namespace nextview
